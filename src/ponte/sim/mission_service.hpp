#pragma once

#include "ponte/core/time.hpp"
#include "ponte/mavlink/autopilots/mission_item.hpp"
#include "ponte/sim/mission_store.hpp"
#include "ponte/sim/speaker.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace ponte::sim {

/// The transfer of missions, fences and rally points between a station and the store. ArduPilot writes each item as it
/// comes, so that a broken upload leaves a mixture; PX4 collects them and exchanges the plan at the end.
class MissionService {
 public:
  using Item = MissionStore::Item;

  /// `store` outlives it.
  MissionService(Personality personality, MissionStore& store);

  /// What the flight does with the mission; told before frames are handed in.
  struct Use {
    std::uint16_t current{};  ///< the item that is flown, or would be
    bool runs{};              ///< it is being flown now
  };
  void set_use(const Use& use) { use_ = use; }

  /// Whether the frame was one of this protocol, for this vehicle; if so it has been answered.
  bool on_frame(Timestamp now, const mavlink::FrameView& frame, mavlink::SystemId us, Speaker& speaker);
  /// Once in each step: asks again for what did not come, and gives up.
  void on_step(Timestamp now, Speaker& speaker);

 private:
  struct Upload {
    PlanType type;
    Requester from;
    std::uint16_t next;
    std::uint16_t end;  // after the last
    Timestamp asked;
    Timestamp heard;
    bool in_integers;  // which form PX4 asks for
    bool is_partial;
  };

  [[nodiscard]] bool is_px4() const { return personality_ == Personality::px4; }
  [[nodiscard]] static std::optional<PlanType> plan_type(std::uint8_t mission_type);

  void on_count(Timestamp now, std::uint16_t count, PlanType type, Requester from, Speaker& speaker);
  void on_write_partial(Timestamp now, std::int16_t first, std::int16_t last, PlanType type, Requester from,
                        Speaker& speaker);
  void on_item(Timestamp now, const Item& item, bool in_integers, Requester from, Speaker& speaker);
  void on_request_list(PlanType type, Requester from, Speaker& speaker);
  void on_request(std::uint16_t sequence, PlanType type, bool in_integers, Requester from, Speaker& speaker);
  void on_clear(std::uint8_t mission_type, Requester from, Speaker& speaker);

  void begin(Timestamp now, const Upload& upload, Speaker& speaker);
  void ask(Timestamp now, Speaker& speaker);
  void finish(Speaker& speaker);
  void acknowledge(unsigned result, PlanType type, Requester to, Speaker& speaker) const;
  void warn_once(bool& warned, std::string_view text, Speaker& speaker) const;

  Personality personality_;
  MissionStore& store_;
  Use use_{};
  std::optional<Upload> upload_;
  std::optional<Upload> done_;  // the last one that was finished
  std::vector<Item> staged_;    // what PX4 has got of an upload
  bool warned_of_items_{};
  bool warned_of_requests_{};
};

}  // namespace ponte::sim
