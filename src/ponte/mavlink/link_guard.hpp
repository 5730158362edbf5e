#pragma once

#include "ponte/core/time.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/signer.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace ponte::mavlink {

/// Which frames without a signature a link takes.
enum class UnsignedPolicy : std::uint8_t {
  all,
  until_signed,  ///< all, until the first frame with a right signature; from then on those of the list
  listed,        ///< those of the list, in MAVLink 2
};

/// What a link demands of the frames that arrive on it.
struct LinkPolicy {
  UnsignedPolicy unsigned_frames{UnsignedPolicy::until_signed};
  /// Messages that are taken unsigned all the same. RADIO_STATUS comes from the radio, which does not know the key.
  std::vector<MessageId> unsigned_list{MessageId{109}};
};

/// Why a frame is not taken.
enum class Refusal : std::uint8_t {
  unsigned_frame,
  downgraded,        ///< of a version that cannot be signed, where signatures are demanded
  wrong_signature,   ///< made with another key, or the frame was changed
  replayed,          ///< not newer than the last one of its stream
  too_old,           ///< the first of its stream, and from more than a minute ago
  too_many_streams,  ///< the first of its stream, and there is no room for another
};
inline constexpr std::size_t refusal_count = 6;
/// "unsigned", "downgraded", "wrong signature", ...
[[nodiscard]] std::string_view name_of(Refusal refusal);

using Refusals = std::array<std::uint64_t, refusal_count>;

/// Keeps frames out of one link that its policy does not permit, and counts them. Without a signer no signature can be
/// examined, and every frame is taken.
class LinkGuard {
 public:
  explicit LinkGuard(LinkPolicy policy) : policy_{std::move(policy)} {}

  /// Judges a frame, whose checksum is right or cannot be examined. Nothing: it is taken.
  [[nodiscard]] std::optional<Refusal> examine(WallTime now, const FrameView& frame, Signer* signer);

  [[nodiscard]] const Refusals& refused() const { return refused_; }

 private:
  [[nodiscard]] std::optional<Refusal> judge(WallTime now, const FrameView& frame, Signer& signer);

  LinkPolicy policy_;
  bool has_heard_signed_{};
  Refusals refused_{};
};

}  // namespace ponte::mavlink
