#include "ponte/mavlink/signer.hpp"

#include "ponte/core/assert.hpp"
#include "ponte/mavlink/crc.hpp"

// The functions that newer OpenSSL replaces by others, which allocate memory for every hash.
#define OPENSSL_API_COMPAT 0x10100000L
#include <openssl/crypto.h>
#include <openssl/sha.h>

#include <algorithm>
#include <cstring>

namespace ponte::mavlink {
namespace {

constexpr WallTime epoch = std::chrono::sys_days{std::chrono::year{2015} / 1 / 1};
constexpr std::chrono::microseconds unit{10};
constexpr std::size_t time_size = 6;
constexpr std::size_t flags_offset = 2;
constexpr std::byte flag_signed{0x01};

SigningTime read_time(Bytes at) {
  return SigningTime{u16_le(at, 0) + (std::uint64_t{load_le<std::uint32_t>(&at[2])} << 16U)};
}

void write_time(std::byte* at, SigningTime time) {
  store_le(at, static_cast<std::uint16_t>(time.value));
  store_le(at + 2, static_cast<std::uint32_t>(time.value >> 16U));
}

/// By how much the flag of a signed frame changes the checksum. As a checksum is linear, the rest of the frame does not
/// matter, but for its length.
std::uint16_t checksum_change(std::size_t payload_size) {
  static constexpr std::array<std::byte, max_frame_size> zeros{};
  constexpr std::size_t crc_extra_size = 1;
  const auto behind_flags = header_size(Version::v2) - flags_offset - 1 + payload_size + crc_extra_size;
  return crc_of(Bytes{zeros}.first(behind_flags), crc_of(std::to_integer<std::uint8_t>(flag_signed), 0));
}

}  // namespace

SigningTime signing_time_from(WallTime time) {
  return SigningTime{time < epoch ? 0U : static_cast<std::uint64_t>((time - epoch) / unit)};
}

std::string_view name_of(SignatureVerdict verdict) {
  switch (verdict) {
    case SignatureVerdict::accepted: return "accepted";
    case SignatureVerdict::wrong: return "wrong signature";
    case SignatureVerdict::replayed: return "replayed";
    case SignatureVerdict::too_old: return "too old";
    case SignatureVerdict::too_many_streams: return "too many streams";
  }
  return {};
}

void Signer::advance(WallTime now) { time_ = std::max(time_, signing_time_from(now)); }

std::array<std::byte, Signer::hash_size> Signer::hash_of(Bytes frame_without_hash) const {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> hash{};
  SHA256_CTX context;
  const auto done = SHA256_Init(&context) == 1 &&
                    SHA256_Update(&context, key_.secret().data(), key_.secret().size()) == 1 &&
                    SHA256_Update(&context, frame_without_hash.data(), frame_without_hash.size()) == 1 &&
                    SHA256_Final(hash.data(), &context) == 1;
  PONTE_ASSERT(done);
  std::array<std::byte, hash_size> result{};
  std::memcpy(result.data(), hash.data(), result.size());
  return result;
}

std::size_t Signer::sign(WallTime now, std::uint8_t link_id, MutableBytes out, std::size_t size) {
  PONTE_ASSERT(out.size() >= size + signature_size);
  const auto frame = parse_frame(out.first(size));
  PONTE_ASSERT(frame && frame->version == Version::v2 && !frame->is_signed() && frame->whole.size() == size);
  const auto checksum_at = size - sizeof(std::uint16_t);
  const auto checksum = static_cast<std::uint16_t>(frame->checksum() ^ checksum_change(frame->payload.size()));
  out[flags_offset] |= flag_signed;
  store_le(&out[checksum_at], checksum);

  advance(now);
  ++time_.value;
  out[size] = std::byte{link_id};
  write_time(&out[size + 1], time_);
  const auto hash = hash_of(out.first(size + 1 + time_size));
  std::memcpy(&out[size + 1 + time_size], hash.data(), hash.size());
  return size + signature_size;
}

SignatureVerdict Signer::verify(WallTime now, const FrameView& frame) {
  PONTE_ASSERT(frame.is_signed());
  const auto hash = hash_of(frame.whole.first(frame.whole.size() - hash_size));
  const auto signature = frame.signature();
  if (CRYPTO_memcmp(hash.data(), signature.last(hash_size).data(), hash_size) != 0) return SignatureVerdict::wrong;
  advance(now);
  const auto link_id = u8(signature, 0);
  const auto sender =
      (std::uint32_t{frame.system.value} << 16U) + (std::uint32_t{frame.component.value} << 8U) + link_id;
  return remember(sender, read_time(signature.subspan(1)));
}

SignatureVerdict Signer::remember(std::uint32_t sender, SigningTime time) {
  const auto end = streams_.begin() + static_cast<std::ptrdiff_t>(stream_count_);
  auto stream = std::ranges::find(streams_.begin(), end, sender, &Stream::sender);
  if (stream != end) {
    if (time <= stream->newest) return SignatureVerdict::replayed;
  } else {
    const auto is_old = [&](SigningTime other) { return other.value + new_stream_window < time_.value; };
    if (is_old(time)) return SignatureVerdict::too_old;
    if (stream_count_ == stream_limit) {
      stream = std::ranges::min_element(streams_, {}, &Stream::newest);
      if (!is_old(stream->newest)) return SignatureVerdict::too_many_streams;
    } else {
      ++stream_count_;
    }
  }
  *stream = {sender, time};
  time_ = std::max(time_, time);
  return SignatureVerdict::accepted;
}

}  // namespace ponte::mavlink
