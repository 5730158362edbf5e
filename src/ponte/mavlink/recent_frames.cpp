#include "ponte/mavlink/recent_frames.hpp"

#include <cstring>

namespace ponte::mavlink {
namespace {

constexpr std::uint64_t mixed(std::uint64_t word) {
  word ^= word >> 32U;
  word *= 0x9FB2'1C65'1E98'DF25;
  return word ^ (word >> 28U);
}

std::uint64_t hash_of(Bytes bytes, std::uint64_t seed) {
  auto hash = mixed(seed ^ bytes.size());
  std::size_t at = 0;
  for (; at + sizeof hash <= bytes.size(); at += sizeof hash) hash = mixed(hash ^ load_le<std::uint64_t>(&bytes[at]));
  std::uint64_t rest = 0;
  if (at < bytes.size()) std::memcpy(&rest, &bytes[at], bytes.size() - at);
  hash = mixed(hash ^ rest) + seed;
  return hash != 0 ? hash : 1;
}

}  // namespace

RecentFrames::Arrival RecentFrames::arrive(Timestamp now, std::uint16_t link, Bytes frame) {
  const auto hash = hash_of(frame, seed_);
  auto& entry = entries_[hash % entry_count];
  const bool is_known = entry.hash == hash && now - entry.time <= window;
  if (is_known && entry.link != link) return Arrival::elsewhere;
  entry = {hash, now, link};
  return is_known ? Arrival::again : Arrival::first;
}

}  // namespace ponte::mavlink
