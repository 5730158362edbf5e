#include "inspect/report.hpp"

#include "common/json_line.hpp"
#include "ponte/dli/json.hpp"
#include "ponte/dli/messages/catalogue.hpp"
#include "ponte/mavlink/json.hpp"

#include <fmt/format.h>

namespace ponte::app {
namespace {

std::string shown(const std::optional<double>& rate) { return rate ? fmt::format("{:.2f}", *rate) : "-"; }

std::string name_of(dli::MessageNumber number, dli::Edition edition) {
  const auto* message = dli::messages::catalogue.find(number);
  return message == nullptr ? "unknown" : std::string{message->name_in(edition)};
}

std::string values_of(const MessageTally& tally) {
  if (tally.message == nullptr) return {};
  JsonText json;
  mavlink::append_fields(json, *tally.message, tally.last_bytes);
  return json.text();
}

/// The last message of a row as the object that every DLI message is printed as; nothing when its data are bad.
std::optional<JsonText> last_of(const Tally& tally, const dli::Profile& profile) {
  const auto message = dli::parse_message(tally.last_bytes, profile);
  JsonText json;
  if (!message || !dli::append_json(json, *message, dli::messages::catalogue, profile, unix_ms(*tally.last)))
    return std::nullopt;
  return json;
}

/// Without what the columns before have said already.
std::string fields_of(const std::string& object) {
  const auto at = object.find("\"fields\":");
  return at == std::string::npos ? object : object.substr(at);
}

}  // namespace

std::string mavlink_table(const Traffic& traffic, const RateOf& rate_of, bool with_values) {
  auto text = fmt::format("{:>3} {:>4} {:>6} {:<42} {:>9} {:>9}\n", "sys", "comp", "id", "message", "count", "Hz");
  for (const auto& [key, tally] : traffic.messages)
    text += fmt::format("{:>3} {:>4} {:>6} {:<42} {:>9} {:>9}{}{}\n", key.system.value, key.component.value,
                        key.message.value, tally.name(key.message), tally.count, shown(rate_of(tally)),
                        with_values ? "  " : "", with_values ? values_of(tally) : "");
  text += fmt::format("\n{:>3} {:>4} {:>9} {:>9} {:>9} {:>9} {:>7}\n", "sys", "comp", "received", "lost", "lost %",
                      "late", "twice");
  for (const auto& sender : traffic.losses.senders()) {
    const auto sent = sender.received + sender.lost();
    text += fmt::format("{:>3} {:>4} {:>9} {:>9} {:>9.3f} {:>9} {:>7}\n", sender.system.value, sender.component.value,
                        sender.received, sender.lost(),
                        sent == 0 ? 0.0 : 100.0 * static_cast<double>(sender.lost()) / static_cast<double>(sent),
                        sender.late, sender.duplicates);
  }
  text += fmt::format("\n{} frames", traffic.frames);
  for (const auto& [byte, count] : traffic.start_bytes) text += fmt::format(", start byte 0x{:02X}: {}", byte, count);
  if (traffic.signed_frames > 0) text += fmt::format(", signed: {}", traffic.signed_frames);
  for (std::size_t i = 0; i < traffic.verdicts.size(); ++i)
    if (traffic.verdicts[i] > 0)
      text += fmt::format(", {}: {}", name_of(static_cast<mavlink::SignatureVerdict>(i)), traffic.verdicts[i]);
  text += '\n';
  for (const auto& [reason, damage] : traffic.damages)
    text += fmt::format("skipped {} bytes: {} ({} times)\n", damage.bytes, reason, damage.count);
  return text;
}

std::string dli_table(const DliTraffic& traffic, const RateOf& rate_of, bool with_values) {
  auto text = fmt::format("{:<12} {:>6} {:<42} {:>9} {:>9}\n", "source", "number", "message", "count", "Hz");
  for (const auto& [key, tally] : traffic.messages) {
    std::string values;
    if (with_values)
      if (const auto last = last_of(tally, traffic.profile())) values = "  " + fields_of(last->text());
    text += fmt::format("{:<12} {:>6} {:<42} {:>9} {:>9}{}\n", to_text(key.source).view(), key.number.value,
                        name_of(key.number, traffic.profile().edition), tally.count, shown(rate_of(tally)), values);
  }
  text += fmt::format("\n{} messages in {} datagrams\n", traffic.counters.messages, traffic.counters.datagrams);
  for (std::size_t i = 0; i < dli::wrapper_error_count; ++i)
    if (const auto count = traffic.counters.errors[i]; count > 0)
      text += fmt::format("refused {}: {}\n", count, name_of(static_cast<dli::WrapperError>(i)));
  return text;
}

void print_json(const Traffic& traffic, const std::string& link) {
  JsonText json;
  for (const auto& [key, tally] : traffic.messages) {
    json.begin_object().member("kind", "message").member("link", std::string_view{link});
    json.member("system", unsigned{key.system.value}).member("component", unsigned{key.component.value});
    json.member("id", unsigned{key.message.value}).member("name", std::string_view{tally.name(key.message)});
    json.member("count", tally.count);
    if (const auto rate = tally.rate()) json.member("rate_hz", *rate);
    if (tally.message != nullptr) {
      json.key("last");
      mavlink::append_fields(json, *tally.message, tally.last_bytes);
    }
    json.end_object();
    print_line(json);
  }
  for (const auto& sender : traffic.losses.senders()) {
    json.begin_object().member("kind", "sender").member("link", std::string_view{link});
    json.member("system", unsigned{sender.system.value}).member("component", unsigned{sender.component.value});
    json.member("received", sender.received).member("lost", sender.lost()).member("late", sender.late);
    json.member("duplicates", sender.duplicates).end_object();
    print_line(json);
  }
  for (std::size_t i = 0; i < traffic.verdicts.size(); ++i) {
    if (traffic.verdicts[i] == 0) continue;
    json.begin_object().member("kind", "signatures").member("link", std::string_view{link});
    json.member("verdict", name_of(static_cast<mavlink::SignatureVerdict>(i))).member("count", traffic.verdicts[i]);
    json.end_object();
    print_line(json);
  }
  for (const auto& [reason, damage] : traffic.damages) {
    json.begin_object().member("kind", "skipped").member("link", std::string_view{link});
    json.member("reason", std::string_view{reason}).member("count", damage.count).member("bytes", damage.bytes);
    json.end_object();
    print_line(json);
  }
}

void print_json(const DliTraffic& traffic, const std::string& link) {
  JsonText json;
  for (const auto& [key, tally] : traffic.messages) {
    json.begin_object().member("kind", "dli_message").member("link", std::string_view{link});
    json.member("source", to_text(key.source).view()).member("number", unsigned{key.number.value});
    json.member("name", std::string_view{name_of(key.number, traffic.profile().edition)}).member("count", tally.count);
    if (const auto rate = tally.rate()) json.member("rate_hz", *rate);
    if (const auto message = dli::parse_message(tally.last_bytes, traffic.profile())) {
      json.key("last");
      if (!dli::append_json(json, *message, dli::messages::catalogue, traffic.profile(), unix_ms(*tally.last)))
        json.value("bad data");
    }
    json.end_object();
    print_line(json);
  }
  for (std::size_t i = 0; i < dli::wrapper_error_count; ++i) {
    const auto count = traffic.counters.errors[i];
    if (count == 0) continue;
    json.begin_object().member("kind", "refused").member("link", std::string_view{link});
    json.member("reason", app::name_of(static_cast<dli::WrapperError>(i))).member("count", count).end_object();
    print_line(json);
  }
}

}  // namespace ponte::app
