#pragma once

#include "ponte/core/time.hpp"
#include "ponte/mavlink/autopilots/param_request_read.hpp"
#include "ponte/mavlink/autopilots/param_set.hpp"
#include "ponte/sim/parameters.hpp"
#include "ponte/sim/speaker.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace ponte::sim {

/// The parameter protocol, as each autopilot speaks it. ArduPilot sends every value as the float of the number, answers
/// single requests within 100 ms and unknown names not at all; PX4 puts the bytes of integers into the float, answers
/// at once, with PARAM_ERROR where it refuses, and begins its list with a hash of all names and values.
class ParameterService {
 public:
  /// `parameters` outlives it. `line_rate`: bytes per second that the line carries, of which the list takes a third;
  /// nothing: all within a second.
  ParameterService(Personality personality, Parameters& parameters, std::optional<std::size_t> line_rate = {});

  void on_request_list();
  void on_request_read(const mavlink::autopilots::ParamRequestRead& request, Requester requester, Speaker& speaker);
  void on_set(const mavlink::autopilots::ParamSet& wish, Requester requester, Speaker& speaker);
  /// Once in each step: what is due of the list, and of answers that wait.
  void on_step(Duration since_boot, Speaker& speaker);

  /// Sets what the autopilot itself counts or measures, and tells everybody if it is new.
  void announce(std::string_view name, double value, Speaker& speaker);

 private:
  static constexpr std::size_t reads_at_most = 20;

  [[nodiscard]] bool is_px4() const { return personality_ == Personality::px4; }
  [[nodiscard]] std::uint32_t hash() const;
  [[nodiscard]] float encoded(std::size_t parameter) const;
  void send(std::size_t parameter, std::uint16_t told_index, Speaker& speaker) const;
  void send_hash(Speaker& speaker) const;
  void refuse(std::string_view name, std::uint8_t error, Requester requester, Speaker& speaker) const;
  void set_px4(std::size_t parameter, const mavlink::autopilots::ParamSet& wish, Requester requester, Speaker& speaker);

  struct Read {
    std::size_t parameter;
    std::uint16_t told_index;
  };

  Personality personality_;
  Parameters& parameters_;
  std::size_t list_items_per_step_;
  std::size_t next_of_list_;  // the size of the list: none is being sent
  std::array<Read, reads_at_most> reads_{};
  std::size_t waiting_reads_{};
  std::vector<bool> repeats_;  // what was set, and is told once more
  std::size_t waiting_repeats_{};
};

}  // namespace ponte::sim
