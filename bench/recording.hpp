#pragma once

#include "common/load_file.hpp"
#include "ponte/core/json_text.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/tlog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

/// What the benchmarks share.
namespace ponte::bench {

/// Calls `visit(record)` for every frame of a recording.
template <class Visitor>
void for_each_frame(Bytes file, Visitor&& visit) {
  mavlink::TlogReader reader{file, mavlink::autopilots::dialect};
  while (const auto part = reader.next())
    if (const auto* record = std::get_if<mavlink::TlogRecord>(&*part)) visit(*record);
}

/// Times of one kind, in nanoseconds.
class Times {
 public:
  void add(double nanoseconds) { times_.push_back(nanoseconds); }
  [[nodiscard]] double quantile(double part) {
    std::ranges::sort(times_);
    return times_[static_cast<std::size_t>(part * static_cast<double>(times_.size() - 1))];
  }

 private:
  std::vector<double> times_;
};

/// One figure for bench/run.py, which knows targets and peers.
inline void print(std::string_view name, double value, std::string_view unit) {
  JsonText json;
  json.begin_object().member("case", name).member("value", value).member("unit", unit).end_object();
  fmt::print("{}\n", json.text());
}

}  // namespace ponte::bench
