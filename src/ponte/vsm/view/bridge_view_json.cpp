// The texts of the view, as web/contract/messages.schema.json has them.

#include "ponte/vsm/view/bridge_view.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <variant>
#include <vector>

namespace ponte::vsm::view {
namespace {

SharedText shared(const JsonText& json) { return std::make_shared<const std::string>(json.text()); }

void append_totals(JsonText& json, std::string_view name, const Totals& totals, Timestamp now) {
  json.key(name).begin_object().member("messages", totals.rate.count()).member("bytes", totals.bytes);
  json.member("rate_hz", totals.rate.hz(now)).member("rejected", totals.rejected).end_object();
}

void append_senders(JsonText& json, VehicleLinkId link, const mavlink::LinkStatistics& statistics) {
  for (const auto& sender : statistics.senders()) {
    json.begin_object().member("link", link.value).member("system", unsigned{sender.system.value});
    json.member("component", unsigned{sender.component.value}).member("received", sender.received);
    json.member("lost", sender.lost()).member("late", sender.late).member("duplicates", sender.duplicates);
    json.end_object();
  }
}

void append_rate(JsonText& json, const RateMeter& rate, Timestamp now) {
  json.member("count", rate.count()).member("rate_hz", rate.hz(now));
}

}  // namespace

SharedText BridgeView::status(Timestamp now) {
  if (status_text_) return status_text_;
  JsonText json;
  json.begin_object().member("kind", "status").member("edition", name_of(config_.profile.edition));
  json.member("profile", std::string_view{config_.profile_name});
  json.member("budget_ms", std::chrono::duration<double, std::milli>(config_.budget).count());
  append_situation(json, situation_);
  append_totals(json, "mavlink", mavlink_, now);
  append_totals(json, "dli", dli_, now);
  json.end_object();
  return status_text_ = shared(json);
}

SharedText BridgeView::timing() {
  if (timing_text_) return timing_text_;
  JsonText json;
  append_timing(json, times_);
  return timing_text_ = shared(json);
}

void BridgeView::set_study(const StudyProgress& progress) {
  static constexpr std::array<std::string_view, 4> states{"none", "running", "done", "failed"};
  JsonText json;
  json.begin_object().member("kind", "study").member("state", states.at(static_cast<std::size_t>(progress.state)));
  json.member("samples", progress.samples).member("limit_ms", progress.limit_ms).member("done", progress.done);
  if (!progress.detail.empty()) json.member("detail", std::string_view{progress.detail});
  json.end_object();
  study_text_ = shared(json);
  ++study_revision_;
}

void BridgeView::append_crossing(JsonText& json, const MavlinkKey& key, const MavlinkRow& row,
                                 StoredCrossing& crossing) {
  json.begin_object().member("number", crossing.number);
  json.key("mavlink").written(MavlinkTable::json_of(key, row, crossing));
  json.key("stages_ns").begin_object().member("decoded", std::int64_t{crossing.decoded.count()});
  if (!crossing.messages.empty())
    json.member("translated", std::int64_t{crossing.translated.count()})
        .member("sent", std::int64_t{crossing.sent.count()});
  json.end_object().key("dli").begin_array();
  for (auto& message : crossing.messages) json.written(dli_table_.json_of(message));
  json.end_array().end_object();
}

News BridgeView::crossings(dli::EntityId vehicle, std::uint64_t since) {
  const auto [entry, is_new] = crossing_news_.try_emplace({vehicle, since}, News{nullptr, last_crossing_});
  auto& news = entry->second;
  if (!is_new) return news;
  const auto watched = std::ranges::find(situation_.vehicles, vehicle, &VehicleOnLink::id);
  if (watched == situation_.vehicles.end()) return news;

  JsonText json;
  json.begin_object().member("kind", "crossings").key("crossings").begin_array();
  bool any = false;
  auto& rows = mavlink_table_.rows();
  const auto is_watched = [&](const MavlinkKey& key) {
    return key.link == watched->link && key.system == watched->system;
  };
  for (auto at = rows.lower_bound({.link = watched->link, .system = watched->system});
       at != rows.end() && is_watched(at->first); ++at) {
    auto& [key, row] = *at;
    auto& crossing = row.translated.number > since ? row.translated : row.plain;
    if (crossing.number <= since) continue;
    append_crossing(json, key, row, crossing);
    any = true;
  }
  for (auto& [key, row] : dli_table_.rows()) {
    const auto source = key.first;
    if (row.clock_number <= since || (source != vehicle && source.type() != dli::EntityType::vsm)) continue;
    json.begin_object().member("number", row.clock_number).key("dli").begin_array();
    json.written(dli_table_.json_of(row.last)).end_array().end_object();
    any = true;
  }
  json.end_array().end_object();
  if (any) news.text = shared(json);
  return news;
}

/// Points to a changed row of one of the tables.
struct BridgeView::Change {
  std::uint64_t revision;
  std::variant<std::pair<const MavlinkKey, MavlinkRow>*, DliTable::Row*, const std::pair<const RejectKey, Reject>*> row;
};

News BridgeView::traffic(std::uint64_t since, Timestamp now) {
  const auto [entry, is_new] = traffic_news_.try_emplace(since, News{nullptr, revision_});
  auto& news = entry->second;
  if (!is_new || since == revision_) return news;

  std::vector<Change> changes;
  const auto add_if_changed = [&](std::uint64_t revision, auto* row) {
    if (revision > since) changes.push_back({revision, row});
  };
  for (auto& row : mavlink_table_.rows()) add_if_changed(row.second.revision, &row);
  for (auto& [key, row] : dli_table_.rows()) add_if_changed(row.revision, &row);
  for (const auto& row : rejects_) add_if_changed(row.second.revision, &row);
  std::ranges::sort(changes, {}, &Change::revision);

  JsonText mavlink, dli, senders, rejects;
  for (auto* json : {&mavlink, &dli, &senders, &rejects}) json->begin_array();
  for (const auto& change : changes) {
    if (mavlink.text().size() + dli.text().size() > traffic_size) {
      news.until = change.revision - 1;
      break;
    }
    if (auto* const* row = std::get_if<std::pair<const MavlinkKey, MavlinkRow>*>(&change.row)) {
      auto& [key, content] = **row;
      append_rate(mavlink.begin_object(), content.rate, now);
      mavlink.key("last").written(MavlinkTable::json_of(key, content, content.last())).end_object();
    } else if (auto* const* sent = std::get_if<DliTable::Row*>(&change.row)) {
      append_rate(dli.begin_object(), (*sent)->rate, now);
      dli.key("last").written(dli_table_.json_of((*sent)->last)).end_object();
    } else {
      const auto& [key, reject] = *std::get<2>(change.row);
      const auto& [side, link, reason] = key;
      rejects.begin_object().member("side", side == Side::mavlink ? "mavlink" : "dli");
      if (side == Side::mavlink) rejects.member("link", link.value);
      rejects.member("reason", reason).member("count", reject.count).member("bytes", reject.bytes).end_object();
    }
  }
  for (const auto& [id, link] : mavlink_table_.links())
    if (link.revision > since) append_senders(senders, id, link.senders);
  for (auto* json : {&mavlink, &dli, &senders, &rejects}) json->end_array();

  JsonText json;
  json.begin_object().member("kind", "traffic").key("mavlink").written(mavlink.text());
  json.key("dli").written(dli.text()).key("senders").written(senders.text());
  json.key("rejects").written(rejects.text()).end_object();
  news.text = shared(json);
  return news;
}

}  // namespace ponte::vsm::view
