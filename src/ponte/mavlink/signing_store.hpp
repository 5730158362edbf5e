#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/mavlink/signer.hpp"

#include <array>
#include <cstddef>

/// How the time of a signer is kept while the program does not run: in two slots that are written in turn, so that the
/// other one is whole whenever writing is interrupted.
namespace ponte::mavlink {

inline constexpr std::size_t signing_slot_size = 16;
inline constexpr std::size_t signing_slot_count = 2;
inline constexpr std::size_t signing_store_size = signing_slot_count * signing_slot_size;

/// The bytes of a slot: the time, and its complement, which tells a torn slot.
[[nodiscard]] std::array<std::byte, signing_slot_size> write_signing_slot(SigningTime time);

struct StoredSigningTime {
  SigningTime time{};       ///< zero when no slot is whole
  std::size_t next_slot{};  ///< to be written next: the torn one, or the older
  bool damaged{};           ///< a slot was torn, or bytes are missing or too many
};
/// Reads both slots, one after the other; a new store has no bytes at all.
[[nodiscard]] StoredSigningTime read_signing_store(Bytes store);

}  // namespace ponte::mavlink
