#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/id.hpp"
#include "ponte/core/time.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/signing_key.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// Signatures of MAVLink 2: who sends a frame knows the key, and has not sent it before. They hide nothing.
namespace ponte::mavlink {

/// The time stamp of signatures: units of 10 microseconds since 2015-01-01 00:00 UTC, 48 bits.
using SigningTime = Id<struct SigningTimeTag, std::uint64_t>;

/// Times before 2015 count as its beginning.
[[nodiscard]] SigningTime signing_time_from(WallTime time);

/// What became of the signature of a frame.
enum class SignatureVerdict : std::uint8_t {
  accepted,
  wrong,             ///< made with another key, or the frame was changed
  replayed,          ///< right, but not newer than the last one of its stream
  too_old,           ///< right, but the first of its stream, and from more than a minute ago
  too_many_streams,  ///< right, but the first of its stream, and there is no room for another
};
inline constexpr std::size_t signature_verdict_count = 5;
/// "accepted", "wrong signature", "replayed", ...
[[nodiscard]] std::string_view name_of(SignatureVerdict verdict);

/// Signs and verifies with one key. All links that use the key share one signer, so that what was heard on one cannot
/// be replayed on another, and no time stamp is used twice. Allocates nothing after it was made.
///
/// Its time never goes back: it is the clock's, or that of the newest frame with a right signature, or one unit later
/// for each frame that was signed, whichever is newest.
class Signer {
 public:
  /// Senders, each being a system, a component and a link id, that are remembered. One from more than a minute ago
  /// gives way to a new one: what could be replayed of it is too old for a new stream.
  static constexpr std::size_t stream_limit = 64;
  /// How old the first frame of a stream may be: a minute.
  static constexpr std::uint64_t new_stream_window = 6'000'000;

  /// `stored` is the time that a signer with this key had at its end, or zero.
  Signer(const SigningKey& key, SigningTime stored) : key_{key}, time_{stored} {}
  Signer(const Signer&) = delete;
  Signer& operator=(const Signer&) = delete;

  /// Signs the unsigned MAVLink 2 frame in the first `size` bytes of `out`, and returns its new size; there is room for
  /// `signature_size` bytes more. `link_id` tells apart the links on which a component sends.
  [[nodiscard]] std::size_t sign(WallTime now, std::uint8_t link_id, MutableBytes out, std::size_t size);

  /// Judges a signed frame, whose checksum is right or cannot be examined. An accepted one is remembered.
  [[nodiscard]] SignatureVerdict verify(WallTime now, const FrameView& frame);

  /// The newest time that was used or heard: what to store.
  [[nodiscard]] SigningTime time() const { return time_; }

 private:
  static constexpr std::size_t hash_size = 6;
  struct Stream {
    std::uint32_t sender{};  ///< system, component, link id
    SigningTime newest{};
  };

  void advance(WallTime now);
  [[nodiscard]] std::array<std::byte, hash_size> hash_of(Bytes frame_without_hash) const;
  [[nodiscard]] SignatureVerdict remember(std::uint32_t sender, SigningTime time);

  SigningKey key_;
  SigningTime time_;
  std::array<Stream, stream_limit> streams_{};
  std::size_t stream_count_{};
};

}  // namespace ponte::mavlink
