#include "ponte/vsm/view/client_feed.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <utility>

namespace ponte::vsm::view {

std::string_view name_of(Role role) { return role == Role::command ? "command" : "watch"; }

Result<WatchRequest, std::string> parse_watch_request(std::string_view text) {
  using nlohmann::json;
  const auto message = json::parse(text, nullptr, false);
  if (!message.is_object() || message.size() != 3 || message.value("kind", json{}) != "watch")
    return fail(std::string{R"(expected {"kind":"watch","vehicle":"14:40:00:01" or null,"traffic":true or false})"});
  const auto vehicle = message.value("vehicle", json{0});
  const auto traffic = message.value("traffic", json{});
  if (!traffic.is_boolean()) return fail(std::string{"traffic: expected true or false"});
  WatchRequest request{.vehicle = {}, .traffic = traffic.get<bool>()};
  if (vehicle.is_null()) return request;
  const auto id = vehicle.is_string() ? dli::parse_entity_id(vehicle.get_ref<const std::string&>())
                                      : Result<dli::EntityId, dli::EntityIdError>{fail(dli::EntityIdError{})};
  if (!id) return fail(std::string{"vehicle: expected null or an id such as 14:40:00:01"});
  request.vehicle = *id;
  return request;
}

ClientFeed::ClientFeed(BridgeView& view, Role role, bool has_session, std::string_view version)
    : view_{&view}, next_event_{view.events().first_for_newcomers()} {
  JsonText json;
  json.begin_object().member("kind", "hello").member("version", version).member("role", name_of(role));
  json.member("session", has_session).end_object();
  hello_ = json.text();
}

bool ClientFeed::on_message(Timestamp now, std::string_view text) {
  if (now - second_began_ >= second) {
    second_began_ = now;
    messages_this_second_ = 0;
  }
  if (++messages_this_second_ > messages_per_second) return false;
  const auto request = parse_watch_request(text);
  if (!request) {
    JsonText json;
    json.begin_object().member("kind", "refusal").member("code", "bad_request");
    json.member("detail", std::string_view{request.error()}).end_object();
    refusal_ = json.text();
    return true;
  }
  if (request->vehicle != request_.vehicle) crossings_.since = view_->last_crossing();
  if (request->traffic && !request_.traffic) traffic_.since = 0;
  request_ = *request;
  return true;
}

void ClientFeed::make_due(Stream& stream, Timestamp now, bool has_news) {
  if (now < stream.next) return;
  stream.next = now + stream.period;
  if (stream.is_due && has_news) ++dropped_;
  stream.is_due = true;
}

void ClientFeed::on_tick(Timestamp now) {
  make_due(crossings_, now, request_.vehicle && view_->last_crossing() > crossings_.since);
  make_due(traffic_, now, request_.traffic && view_->traffic_revision() > traffic_.since);
  make_due(timing_, now, true);
}

SharedText ClientFeed::take(Timestamp now) {
  if (!hello_.empty()) return std::make_shared<const std::string>(std::exchange(hello_, {}));
  if (auto text = take_state(now)) return text;
  return take_telemetry(now);
}

SharedText ClientFeed::take_state(Timestamp now) {
  if (told_situation_ != view_->situation_revision() || now >= next_status_) {
    told_situation_ = view_->situation_revision();
    next_status_ = now + second;
    return view_->status(now);
  }
  if (const auto& events = view_->events(); next_event_ <= events.last() && !has_lost_events()) {
    JsonText json;
    events.append_from(json, next_event_);
    next_event_ = events.last() + 1;
    return std::make_shared<const std::string>(json.text());
  }
  if (told_study_ != view_->study_revision()) {
    told_study_ = view_->study_revision();
    return view_->study();
  }
  if (!refusal_.empty()) return std::make_shared<const std::string>(std::exchange(refusal_, {}));
  if (told_dropped_ != dropped_ && now >= next_dropped_) {
    told_dropped_ = dropped_;
    next_dropped_ = now + second;
    return std::make_shared<const std::string>(fmt::format(R"({{"kind":"dropped","count":{}}})", dropped_));
  }
  return nullptr;
}

SharedText ClientFeed::take_telemetry(Timestamp now) {
  if (std::exchange(crossings_.is_due, false) && request_.vehicle) {
    const auto news = view_->crossings(*request_.vehicle, crossings_.since);
    crossings_.since = news.until;
    if (news.text) return news.text;
  }
  if (std::exchange(traffic_.is_due, false) && request_.traffic) {
    const auto news = view_->traffic(traffic_.since, now);
    traffic_.since = news.until;
    if (news.text) return news.text;
  }
  if (std::exchange(timing_.is_due, false)) return view_->timing();
  return nullptr;
}

}  // namespace ponte::vsm::view
