#pragma once

#include "ponte/mavlink/crc.hpp"
#include "ponte/mavlink/frame.hpp"

#include <cstddef>

namespace ponte::mavlink {

/// The checksum that the frame of MAVLink 0.9 at the beginning of `bytes` has to have, if it is there whole.
inline void repair_v09(MutableBytes bytes) {
  if (bytes.size() < 2 || bytes[0] != start_v0_9) return;
  const auto end = header_size(Version::v0_9) + u8(bytes, 1);
  if (end + 2 <= bytes.size()) store_le(&bytes[end], crc_of(bytes.subspan(1, end - 1)));
}

/// Gives every frame of a known message its right checksum, beginning with the first. Without this, a fuzzer would
/// hardly ever get beyond the checksum.
inline void repair_checksums(MutableBytes bytes, const Dialect& dialect) {
  for (std::size_t at = find_start(bytes); at < bytes.size(); at += find_start(bytes.subspan(at))) {
    repair_v09(bytes.subspan(at));
    const auto frame = parse_frame(bytes.subspan(at));
    const auto* message = frame ? find_message(dialect, *frame) : nullptr;
    if (message == nullptr) {
      ++at;
      continue;
    }
    const auto end = header_size(frame->version) + frame->payload.size();
    if (frame->version != Version::v0_9)
      store_le(&bytes[at + end], crc_of(message->crc_extra, crc_of(frame->whole.subspan(1, end - 1))));
    at += frame->whole.size();
  }
}

}  // namespace ponte::mavlink
