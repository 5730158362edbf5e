#include "ponte/vsm/view/stage_times.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ponte::vsm::view {

std::size_t Histogram::bin_of(std::uint64_t ns) {
  if (ns < 1U << bin_bits) return ns;
  const auto exponent = static_cast<unsigned>(std::bit_width(ns)) - 1U;
  const auto within = (ns >> (exponent - bin_bits)) & ((1U << bin_bits) - 1U);
  return ((exponent - bin_bits + 1U) << bin_bits) + within;
}

std::uint64_t Histogram::last_of_bin(std::size_t bin) {
  if (bin < 1U << bin_bits) return bin;
  const auto shift = (bin >> bin_bits) - 1U;
  const auto first = ((bin & ((1U << bin_bits) - 1U)) + (1U << bin_bits)) << shift;
  return first + (std::uint64_t{1} << shift) - 1U;
}

void Histogram::add(Duration duration) {
  const auto ns = static_cast<std::uint64_t>(std::max<Duration::rep>(duration.count(), 0));
  ++count_;
  sum_ns_ += ns;
  max_ns_ = std::max(max_ns_, ns);
  ++bins_[bin_of(ns)];
  ++buckets_[static_cast<std::size_t>(std::ranges::lower_bound(bounds_ns, ns) - bounds_ns.begin())];
}

std::uint64_t Histogram::percentile_ns(double share) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    seen += bins_[bin];
    if (seen > 0 && seen >= wanted) return std::min(last_of_bin(bin), max_ns_);
  }
  return 0;
}

void StageTimes::add(const Crossing& crossing) {
  decode.add(crossing.decoded - crossing.received);
  translate.add(crossing.translated - crossing.decoded);
  send.add(crossing.sent - crossing.translated);
  total.add(crossing.sent - crossing.received);
}

namespace {

void append_stage(JsonText& json, std::string_view name, const Histogram& times) {
  json.key(name).begin_object();
  json.member("count", times.count());
  json.member("p50_ns", times.percentile_ns(0.50)).member("p95_ns", times.percentile_ns(0.95));
  json.member("p99_ns", times.percentile_ns(0.99)).member("max_ns", times.max_ns());
  json.key("buckets").begin_array();
  for (const auto count : times.buckets()) json.value(count);
  json.end_array().end_object();
}

}  // namespace

void append_timing(JsonText& json, const StageTimes& times) {
  json.begin_object().member("kind", "timing");
  json.key("bounds_ns").begin_array();
  for (const auto bound : Histogram::bounds_ns) json.value(bound);
  json.end_array();
  append_stage(json, "decode", times.decode);
  append_stage(json, "translate", times.translate);
  append_stage(json, "send", times.send);
  append_stage(json, "total", times.total);
  json.end_object();
}

}  // namespace ponte::vsm::view
