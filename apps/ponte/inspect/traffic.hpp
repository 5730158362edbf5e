#pragma once

#include "common/capture.hpp"
#include "inspect/tally.hpp"
#include "ponte/mavlink/link_statistics.hpp"
#include "ponte/mavlink/signer.hpp"

#include <map>
#include <string>

namespace ponte::app {

/// What came from one sender as one message type.
struct MessageTally : Tally {
  const mavlink::MessageInfo* message{};  ///< nothing: not in the dialect; `last_bytes` is the payload

  [[nodiscard]] std::string name(mavlink::MessageId id) const;
};

/// Adds up what a capture holds: by message type, by sender, and what is no frame.
class Traffic final : public CaptureSink {
 public:
  /// With a key, signatures are verified.
  explicit Traffic(const std::optional<mavlink::SigningKey>& key) {
    if (key) signer_.emplace(*key, mavlink::SigningTime{});
  }

  void on_frame(std::size_t offset, std::optional<WallTime> time, const mavlink::FrameView& frame,
                const mavlink::MessageInfo* message) override;
  void on_damage(std::size_t offset, std::optional<WallTime> time, Bytes bytes, std::string_view reason) override;

  struct Key {
    mavlink::SystemId system{};
    mavlink::ComponentId component{};
    mavlink::MessageId message{};
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  struct Damage {
    std::uint64_t count{};
    std::uint64_t bytes{};
  };

  std::map<Key, MessageTally> messages;
  std::map<std::string, Damage> damages;
  std::map<std::uint8_t, std::uint64_t> start_bytes;  ///< 0x55, 0xFE, 0xFD: frames that began with it
  mavlink::LinkStatistics losses;
  std::uint64_t frames{};
  std::uint64_t signed_frames{};
  /// What became of them; all zero without a key.
  std::array<std::uint64_t, mavlink::signature_verdict_count> verdicts{};
  std::string first_damage;

 private:
  std::optional<mavlink::Signer> signer_;
};

}  // namespace ponte::app
