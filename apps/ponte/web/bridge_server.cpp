#include "web/bridge_server.hpp"

#include "common/failure.hpp"
#include "ponte/core/hex.hpp"
#include "ponte/dli/messages/catalogue.hpp"
#include "ponte/transport/serial_ports.hpp"
#include "ports/ports.hpp"
#include "web/catalogue.hpp"

#include <fmt/format.h>
#include <openssl/rand.h>

#include <unistd.h>

#include <array>
#include <utility>
#include <variant>

namespace ponte::app {
namespace {

using vsm::view::EventCode;
using vsm::view::Severity;

/// 32 hex digits that nobody can guess.
std::string new_secret() {
  std::array<unsigned char, 16> bytes{};
  if (::RAND_bytes(bytes.data(), bytes.size()) != 1) throw Failure{"the system has no randomness for secrets"};
  return to_hex(std::as_bytes(std::span{bytes}));
}

bool is_loopback(std::string_view host) { return host.starts_with("127.") || host == "::1"; }

/// A host as it stands in an address of the Web.
std::string web_host(const std::string& host) {
  return host.find(':') == std::string::npos ? host : fmt::format("[{}]", host);
}

/// What people may call this machine when they ask for the page.
HostNames host_names(const std::string& host) {
  if (is_loopback(host)) return {.names = {"localhost", "127.0.0.1", "[::1]", web_host(host)}};
  HostNames hosts{.names = {"localhost", web_host(host)}, .any_address = host == "0.0.0.0" || host == "::"};
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) == 0) {
    hosts.names.emplace_back(name.data());
    hosts.names.push_back(fmt::format("{}.local", name.data()));
  }
  return hosts;
}

/// Other machines can reach us, and no secret keeps them out.
bool needs_token(const BridgeServerOptions& options) {
  return !options.tokens.any() && !is_loopback(options.http.address.host);
}

BridgeServerOptions completed(BridgeServerOptions options) {
  if (options.web_root.empty()) options.web_root = find_web_root();
  if (needs_token(options)) options.tokens.command = new_secret();
  return options;
}

EventCode code_of(autopilot::FleetFact::Kind kind) {
  using enum autopilot::FleetFact::Kind;
  switch (kind) {
    case appeared: return EventCode::vehicle_found;
    case lost: return EventCode::vehicle_lost;
    case returned: return EventCode::vehicle_returned;
    case rebooted: return EventCode::vehicle_rebooted;
    case duplicate_id: break;
  }
  return EventCode::duplicate_id;
}

}  // namespace

BridgeServer::BridgeServer(transport::Loop& loop, LiveVsm& live_vsm, BridgeServerOptions options, Log log)
    : has_made_token_{needs_token(options)},
      options_{completed(std::move(options))},
      loop_{loop},
      vsm_{live_vsm},
      log_{std::move(log)},
      view_{dli::messages::catalogue,
            {.profile = live_vsm.config().telemetry.profile, .profile_name = options_.profile_name}},
      study_{loop, live_vsm.config().telemetry.profile, view_},
      access_{options_.tokens, new_secret},
      files_{options_.web_root.empty() ? StaticFiles{} : StaticFiles{options_.web_root}},
      router_{access_, files_, *this, host_names(options_.http.address.host), !options_.http.certificate.empty()},
      http_{loop, options_.http, *this},
      timer_{loop, [this](Timestamp now) { on_tick(now); }} {
  router_.set_catalogue(
      catalogue_json(*live_vsm.config().dialect, dli::messages::catalogue, live_vsm.config().telemetry.profile));
  if (files_.empty()) log_->warn("the bridge page is not built, so only /api is served; ./run build builds it");
  vsm_.watch(*this);
  on_tick(loop_.now());
}

BridgeServer::~BridgeServer() { vsm_.unwatch(*this); }

std::string BridgeServer::url() const {
  const auto& host = options_.http.address.host;
  const bool is_any = host == "0.0.0.0" || host == "::";
  return fmt::format("{}://{}:{}/{}", options_.http.certificate.empty() ? "http" : "https",
                     is_any ? "localhost" : web_host(host), http_.port(),
                     has_made_token_ ? "#token=" + options_.tokens.command : "");
}

void BridgeServer::on_tick(Timestamp now) {
  look_at_vsm();
  view_.on_tick(now);
  http_.on_tick(now);
  timer_.set(now + vsm::view::ClientFeed::crossing_period);
}

void BridgeServer::on_crossing(const vsm::Crossing& crossing) {
  view_.on_crossing(crossing);
  study_.on_crossing(crossing);
}

void BridgeServer::on_clock(Timestamp now, std::span<const vsm::OutgoingMessage> messages) {
  view_.on_clock(now, messages);
}

void BridgeServer::on_skipped(vsm::VehicleLinkId link, Bytes run, mavlink::SkipReason reason) {
  view_.on_skipped(link, run, reason);
}

void BridgeServer::on_refused(std::string_view reason, std::size_t bytes) { view_.on_refused(reason, bytes); }

void BridgeServer::on_link(const vsm::view::VehicleLink& link) {
  look_at_vsm();
  view_.events().add({.time = transport::Loop::wall(),
                      .code = link.is_up ? EventCode::link_up : EventCode::link_down,
                      .severity = link.is_up ? Severity::info : Severity::warning,
                      .text = link.detail.empty() ? link.endpoint : link.endpoint + ": " + link.detail});
}

void BridgeServer::on_fact(vsm::VehicleLinkId, const autopilot::FleetFact& fact) {
  using Kind = autopilot::FleetFact::Kind;
  look_at_vsm();
  const bool is_bad = fact.kind == Kind::lost || fact.kind == Kind::duplicate_id;
  const auto owner = vsm_.config().telemetry.vsm.owning_code();
  view_.events().add({.time = transport::Loop::wall(),
                      .code = code_of(fact.kind),
                      .severity = is_bad ? Severity::warning : Severity::info,
                      .vehicle = dli::EntityId{owner, dli::EntityType::vehicle, fact.system.value},
                      .text = fmt::format("system {} component {}", fact.system.value, fact.component.value)});
}

void BridgeServer::on_conversion(bool on) {
  look_at_vsm();
  if (on) view_.restart_times();
  view_.events().add(
      {.time = transport::Loop::wall(), .code = on ? EventCode::conversion_on : EventCode::conversion_off});
}

std::string BridgeServer::metrics() { return metrics_text(view_, http_.counters()); }

vsm::view::SharedText BridgeServer::status() {
  look_at_vsm();
  return view_.status(loop_.now());
}

std::string BridgeServer::ports() {
  JsonText json;
  json.begin_array();
  for (const auto& port : transport::serial_ports()) append_port(json, port);
  json.end_array();
  return json.text();
}

HttpResponse BridgeServer::connect(const std::string& text) {
  const auto refuse = [](std::string_view why) { return problem(400, "bad_endpoint", why); };
  const auto endpoint = transport::parse_endpoint(text);
  if (!endpoint) return refuse(transport::to_text(endpoint.error()));
  // Otherwise who may command a vehicle could also try which files there are.
  if (std::holds_alternative<transport::FileEndpoint>(*endpoint))
    return refuse("a recording is given to ponte vsm --vehicle; expected a link to vehicles");
  if (view_.situation().vehicle_links.size() >= vsm::view::MavlinkTable::link_limit)
    return problem(409, "busy", "there are 64 links; disconnect one first");
  try {
    const auto id = vsm_.add_vehicle(*endpoint);
    log_->info("{} is opened from the page", transport::to_text(*endpoint));
    look_at_vsm();
    JsonText json;
    vsm::view::append_vehicle_link(json, {.id = id, .endpoint = transport::to_text(*endpoint)});
    return {.status = 201, .body = shared_text(json.text())};
  } catch (const Failure& failure) {
    return problem(409, "busy", failure.what());
  }
}

bool BridgeServer::disconnect(std::uint32_t link) {
  const bool was_there = vsm_.remove_vehicle(vsm::VehicleLinkId{link});
  look_at_vsm();
  return was_there;
}

void BridgeServer::convert(bool on) {
  if (on == vsm_.converts()) return;
  log_->info("conversion is switched {} from the page", on ? "on" : "off");
  vsm_.convert(on);
}

bool BridgeServer::start_study(std::uint64_t samples, double limit_ms) { return study_.start(samples, limit_ms); }

void BridgeServer::stop_study() { study_.stop(); }

std::optional<std::string> BridgeServer::study_result(std::string_view format) { return study_.result(format); }

HttpResponse BridgeServer::handle(Timestamp now, const HttpRequest& request) { return router_.handle(now, request); }

Result<std::unique_ptr<vsm::view::ClientFeed>, HttpResponse> BridgeServer::admit(const HttpRequest& request) {
  auto role = router_.admit(request);
  if (!role) return fail(std::move(role.error()));
  return std::make_unique<vsm::view::ClientFeed>(view_, *role, access_.needs_session(), PONTE_VERSION);
}

}  // namespace ponte::app
