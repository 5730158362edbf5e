#pragma once

#include "inspect/dli_traffic.hpp"
#include "inspect/traffic.hpp"

#include <functional>
#include <string>

/// What was seen, as a table or as JSON lines.
namespace ponte::app {

/// Messages per second of a row, if that is known.
using RateOf = std::function<std::optional<double>(const Tally&)>;

/// Message types, senders with their losses, and bytes that are no frame; with the last values behind each message
/// type if there is room for long lines.
[[nodiscard]] std::string mavlink_table(const Traffic& traffic, const RateOf& rate_of, bool with_values);
[[nodiscard]] std::string dli_table(const DliTraffic& traffic, const RateOf& rate_of, bool with_values);

void print_json(const Traffic& traffic, const std::string& link);
void print_json(const DliTraffic& traffic, const std::string& link);

}  // namespace ponte::app
