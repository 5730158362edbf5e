#include "common/recording.hpp"

#include "common/failure.hpp"
#include "common/load_file.hpp"

#include <fmt/format.h>

namespace ponte::app {

Recording::Recording(const std::string& path, const mavlink::Dialect& dialect) {
  const auto file = load_file(path);
  read_capture(file.bytes, dialect, *this);
  if (first_damage_.empty()) first_damage_ = file.damage;
  if (entries_.empty())
    throw Failure{fmt::format("{}: no MAVLink frame in {} bytes{}{}", path, file.bytes.size(),
                              first_damage_.empty() ? "" : "; ", first_damage_)};
  if (!has_times_)
    throw Failure{fmt::format(
        "{}: the bytes of a line have no times, so they cannot be replayed; ponte translate reads them", path)};
}

void Recording::on_frame(std::size_t, std::optional<WallTime> time, const mavlink::FrameView& frame,
                         const mavlink::MessageInfo*) {
  if (!time) has_times_ = false;
  bytes_.insert(bytes_.end(), frame.whole.begin(), frame.whole.end());
  entries_.push_back({time.value_or(WallTime{}), bytes_.size()});
}

void Recording::on_damage(std::size_t offset, std::optional<WallTime>, Bytes, std::string_view reason) {
  if (first_damage_.empty()) first_damage_ = fmt::format("offset {}: {}", offset, reason);
}

transport::ReplaySource Recording::replay() const {
  return [this, index = std::size_t{}]() mutable -> std::optional<transport::ReplayRecord> {
    if (index == entries_.size()) return std::nullopt;
    const auto begin = index == 0 ? 0 : entries_[index - 1].end;
    const auto& entry = entries_[index++];
    return transport::ReplayRecord{entry.time, Bytes{bytes_}.subspan(begin, entry.end - begin)};
  };
}

}  // namespace ponte::app
