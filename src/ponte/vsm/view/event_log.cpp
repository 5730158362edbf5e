#include "ponte/vsm/view/event_log.hpp"

#include <array>
#include <utility>

namespace ponte::vsm::view {
namespace {

std::string_view name_of(EventCode code) {
  constexpr std::array<std::string_view, 12> names{
      "link_up",          "link_down",    "vehicle_found", "vehicle_lost",  "vehicle_returned", "vehicle_rebooted",
      "duplicate_id",     "status_text",  "conversion_on", "conversion_off", "study_done",      "study_failed"};
  return names.at(static_cast<std::size_t>(code));
}

std::string_view name_of(Severity severity) {
  constexpr std::array<std::string_view, 3> names{"info", "warning", "error"};
  return names.at(static_cast<std::size_t>(severity));
}

}  // namespace

void EventLog::add(Event event) {
  event.text.resize(std::min(event.text.size(), text_size_max));
  if (events_.size() == capacity) events_.pop_front();
  events_.push_back(std::move(event));
  ++last_;
}

void EventLog::append_from(JsonText& json, std::uint64_t from) const {
  json.begin_object().member("kind", "events").key("events").begin_array();
  for (auto number = from; number <= last_; ++number) {
    const auto& event = events_[number - first()];
    json.begin_object().member("number", number).member("time_ms", std::int64_t{unix_ms(event.time)});
    json.member("code", name_of(event.code)).member("severity", name_of(event.severity));
    if (event.vehicle) json.member("vehicle", to_text(*event.vehicle).view());
    json.member("text", std::string_view{event.text}).end_object();
  }
  json.end_array().end_object();
}

}  // namespace ponte::vsm::view
