#pragma once

#include "ponte/core/json_text.hpp"
#include "ponte/core/time.hpp"
#include "ponte/vsm/series.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The study of 2016: how much later does a person see an attitude when it comes through the DLI? Each sample is one
/// ATTITUDE that became one #4000 and was presented both ways, so that both times belong to the same message.
namespace ponte::vsm {

/// One message on its way. The stamps are those of one monotonic clock, in this order.
struct LatencySample {
  WallTime time{};          ///< of receiving
  std::uint8_t sequence{};  ///< of the MAVLink frame
  Timestamp received{};     ///< its last byte
  Timestamp decoded{};      ///< found in the bytes, checksum examined
  Timestamp translated{};   ///< the #4000 is encoded
  Timestamp sent{};         ///< it is handed to the network
  /// How long it takes to write the message out for people, from the MAVLink frame as it was decoded, and from the
  /// bytes of the #4000, which a ground station decodes first. Measured after `sent`, so that neither counts as a
  /// stage.
  Duration present_direct{};
  Duration present_converted{};

  /// Receive, decode, present.
  [[nodiscard]] Duration direct() const { return decoded - received + present_direct; }
  /// Receive, decode, translate, encode, send, present.
  [[nodiscard]] Duration converted() const { return sent - received + present_converted; }
  /// What conversion adds. Negative if the DLI message takes that much less time to present.
  [[nodiscard]] Duration delay() const { return converted() - direct(); }
};

/// A time that a sample has.
struct LatencyQuantity {
  std::string_view name;     ///< e.g. "direct"
  std::string_view meaning;  ///< a few words for people, e.g. "receive, decode, present"
  Duration (*of)(const LatencySample&);
};
/// direct, converted and delay, then the stages that they are made of.
[[nodiscard]] std::span<const LatencyQuantity> latency_quantities();

/// Something a reader has to know to judge the figures, e.g. the kernel.
struct LatencyCondition {
  std::string name;
  std::string value;
};

/// A finished study, or as much of one as there is.
struct LatencyStudy {
  Duration limit = std::chrono::milliseconds{500};
  std::vector<LatencySample> samples{};
  /// By how much a periodic timer of the same program came late meanwhile; empty when nobody looked.
  std::vector<double> wakeups_late_us{};
  std::vector<LatencyCondition> conditions{};
};

/// Exact to the nanosecond.
[[nodiscard]] double microseconds(Duration time);

/// One time of all samples, in microseconds.
[[nodiscard]] std::vector<double> series_of(const LatencyStudy& study, Duration (*of)(const LatencySample&));
/// Of one time, in microseconds. The study has samples.
[[nodiscard]] SeriesSummary summary_of(const LatencyStudy& study, Duration (*of)(const LatencySample&));

/// Judges the greatest delay, so that a single late sample fails the study: passes if every delay is below the limit,
/// and there are samples.
[[nodiscard]] bool passes(const LatencyStudy& study);

/// Appends one sample as an object: `{"index":1,"time_us":...,"sequence":7,"received_us":0,"decoded_us":...,...,
/// "direct_us":...,"converted_us":...,"delay_us":...}`. `time_us` is UTC since 1970, `received_us` counts from the
/// first sample's `received`, the other stamps from the same sample's, the rest are durations. Indices count from 1.
void append_sample(JsonText& json, const LatencyStudy& study, std::size_t index);

/// Appends verdict, summaries in microseconds and conditions as members of the object that is open: `"limit_ms":500,
/// "pass":true,"summary":{"direct":{"mean_us":...,...},...},"wakeups_late":{...},"conditions":{...}`. The study has
/// samples.
void append_summary(JsonText& json, const LatencyStudy& study);

/// Appends all of a study as one object: the members of `append_summary`, then `"samples":[...]`. It has samples.
void append_study(JsonText& json, const LatencyStudy& study);

/// A header with the names of the members of `append_sample`, then one line per sample; numbers in their shortest exact
/// form, lines end with a line feed. The study has samples.
[[nodiscard]] std::string csv_text(const LatencyStudy& study);

}  // namespace ponte::vsm
