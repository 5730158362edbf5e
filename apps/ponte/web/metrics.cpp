#include "web/metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace ponte::app {
namespace {

class Page {
 public:
  template <class Number>
  void add(std::string_view name, std::string_view type, std::string_view help, Number value) {
    begin(name, type, help);
    line(name, "", value);
  }
  void begin(std::string_view name, std::string_view type, std::string_view help) {
    fmt::format_to(std::back_inserter(text_), "# HELP {0} {2}\n# TYPE {0} {1}\n", name, type, help);
  }
  template <class Number>
  void line(std::string_view name, std::string_view labels, Number value) {
    fmt::format_to(std::back_inserter(text_), "{}{} {}\n", name, labels, value);
  }
  [[nodiscard]] std::string text() && { return std::move(text_); }

 private:
  std::string text_;
};

template <class Value>
void add_sides(Page& page, std::string_view name, std::string_view help, const Value& value,
               const vsm::view::BridgeView& view) {
  page.begin(name, "counter", help);
  page.line(name, R"({side="mavlink"})", value(view.mavlink()));
  page.line(name, R"({side="dli"})", value(view.dli()));
}

void add_times(Page& page, const vsm::view::Histogram& times) {
  constexpr std::string_view name = "ponte_crossing_seconds";
  page.begin(name, "histogram", "From the reception of a frame until its DLI messages were sent.");
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < vsm::view::Histogram::bounds_ns.size(); ++i) {
    count += times.buckets()[i];
    const auto bound = static_cast<double>(vsm::view::Histogram::bounds_ns[i]) / 1e9;
    page.line("ponte_crossing_seconds_bucket", fmt::format(R"({{le="{}"}})", bound), count);
  }
  page.line("ponte_crossing_seconds_bucket", R"({le="+Inf"})", times.count());
  page.line("ponte_crossing_seconds_sum", "", static_cast<double>(times.sum_ns()) / 1e9);
  page.line("ponte_crossing_seconds_count", "", times.count());
}

}  // namespace

std::string metrics_text(const vsm::view::BridgeView& view, const ServerCounters& server) {
  using vsm::view::Totals;
  const auto& now = view.situation();
  Page page;
  add_sides(page, "ponte_messages_total", "Good messages: MAVLink received, DLI sent.",
            [](const Totals& totals) { return totals.rate.count(); }, view);
  add_sides(page, "ponte_bytes_total", "Bytes of good messages.", [](const Totals& totals) { return totals.bytes; },
            view);
  add_sides(page, "ponte_rejected_total", "Pieces of received bytes that were no good message.",
            [](const Totals& totals) { return totals.rejected; }, view);
  add_times(page, view.times().total);
  page.add("ponte_vehicles_present", "gauge", "Vehicles that are heard.",
           std::ranges::count(now.vehicles, true, &vsm::view::VehicleOnLink::is_present));
  page.add("ponte_vehicle_links_up", "gauge", "Endpoints on which somebody is heard.",
           std::ranges::count(now.vehicle_links, true, &vsm::view::VehicleLink::is_up));
  page.add("ponte_conversion", "gauge", "1 while MAVLink is translated.", now.converts ? 1 : 0);
  page.add("ponte_events_total", "counter", "Events told to clients.", view.events().last());
  page.add("ponte_http_connections", "gauge", "Open connections.", server.connections);
  page.add("ponte_http_requests_total", "counter", "Requests answered.", server.requests);
  page.add("ponte_stream_clients", "gauge", "Open WebSockets.", server.stream_clients);
  page.add("ponte_streams_total", "counter", "WebSockets opened.", server.streams_opened);
  page.add("ponte_telemetry_dropped_total", "counter", "Telemetry messages that clients were too slow for.",
           server.telemetry_dropped);
  return std::move(page).text();
}

}  // namespace ponte::app
