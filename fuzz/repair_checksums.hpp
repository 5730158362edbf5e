#pragma once

#include "ponte/mavlink/crc.hpp"
#include "ponte/mavlink/frame.hpp"

#include <cstddef>

namespace ponte::mavlink {

/// Gives every frame of a known message its right checksum, beginning with the first. Without this, a fuzzer would
/// hardly ever get beyond the checksum.
inline void repair_checksums(MutableBytes bytes, const Dialect& dialect) {
  for (std::size_t at = find_start(bytes); at < bytes.size(); at += find_start(bytes.subspan(at))) {
    const auto frame = parse_frame(bytes.subspan(at));
    const auto* message = frame ? dialect.find(frame->message) : nullptr;
    if (message == nullptr) {
      ++at;
      continue;
    }
    const auto end = header_size(frame->version) + frame->payload.size();
    store_le(&bytes[at + end], crc_of(message->crc_extra, crc_of(frame->whole.subspan(1, end - 1))));
    at += frame->whole.size();
  }
}

}  // namespace ponte::mavlink
