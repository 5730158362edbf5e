#include "ponte/sim/mission_service.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/mission_ack.hpp"
#include "ponte/mavlink/autopilots/mission_clear_all.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"
#include "ponte/mavlink/autopilots/mission_request.hpp"
#include "ponte/mavlink/autopilots/mission_request_int.hpp"
#include "ponte/mavlink/autopilots/mission_request_list.hpp"
#include "ponte/mavlink/autopilots/mission_write_partial_list.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/sim/mission_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

/// How long a station may stay silent before it is asked again, and before it is given up.
struct Patience {
  Duration ask_again;
  Duration give_up;
};

constexpr Patience patience_of(Personality personality) {
  using std::chrono::milliseconds;
  if (personality == Personality::ardupilot) return {milliseconds{1000}, milliseconds{8000}};
  return {milliseconds{250}, milliseconds{5000}};
}

std::string_view received_text(PlanType type) {
  switch (type) {
    case PlanType::mission: return "Flight plan received";
    case PlanType::fence: return "Fence Indexed OK";
    case PlanType::rally: return "Rally points received";
  }
  return {};
}

}  // namespace

MissionService::MissionService(Personality personality, MissionStore& store)
    : personality_{personality}, store_{store} {
  for (const auto type : {PlanType::mission, PlanType::fence, PlanType::rally})
    staged_.reserve(std::max(staged_.capacity(), store.capacity(type)));
}

std::optional<PlanType> MissionService::plan_type(std::uint8_t mission_type) {
  if (mission_type >= plan_types) return std::nullopt;
  return static_cast<PlanType>(mission_type);
}

bool MissionService::on_frame(Timestamp now, const mavlink::FrameView& frame, mavlink::SystemId us, Speaker& speaker) {
  const Requester from{frame.system, frame.component};
  /// Decodes the message, and hands it on if it is for us and of a type of plan that exists.
  const auto handle = [&](auto message, auto&& act) {
    message = mavlink::decode<decltype(message)>(frame);
    if (message.target_system != 0 && message.target_system != us.value) return true;
    if (const auto type = plan_type(message.mission_type)) act(message, *type);
    return true;
  };
  switch (frame.message.value) {
    case messages::MissionCount::info.id.value:
      return handle(messages::MissionCount{},
                    [&](const auto& m, PlanType type) { on_count(now, m.count, type, from, speaker); });
    case messages::MissionWritePartialList::info.id.value:
      return handle(messages::MissionWritePartialList{}, [&](const auto& m, PlanType type) {
        on_write_partial(now, m.start_index, m.end_index, type, from, speaker);
      });
    case messages::MissionItemInt::info.id.value:
      return handle(messages::MissionItemInt{}, [&](const auto& m, PlanType) { on_item(now, m, true, from, speaker); });
    case messages::MissionItem::info.id.value:
      return handle(messages::MissionItem{},
                    [&](const auto& m, PlanType) { on_item(now, to_integers(personality_, m), false, from, speaker); });
    case messages::MissionRequestList::info.id.value:
      return handle(messages::MissionRequestList{},
                    [&](const auto&, PlanType type) { on_request_list(type, from, speaker); });
    case messages::MissionRequestInt::info.id.value:
      return handle(messages::MissionRequestInt{},
                    [&](const auto& m, PlanType type) { on_request(m.seq, type, true, from, speaker); });
    case messages::MissionRequest::info.id.value:
      return handle(messages::MissionRequest{},
                    [&](const auto& m, PlanType type) { on_request(m.seq, type, false, from, speaker); });
    case messages::MissionClearAll::info.id.value: {
      const auto m = mavlink::decode<messages::MissionClearAll>(frame);
      if (m.target_system == 0 || m.target_system == us.value) on_clear(m.mission_type, from, speaker);
      return true;
    }
    default: return false;
  }
}

void MissionService::acknowledge(unsigned result, PlanType type, Requester to, Speaker& speaker) const {
  const bool tells_id = is_px4() && result == messages::MAV_MISSION_ACCEPTED;
  speaker.send(messages::MissionAck{.target_system = to.system.value,
                                    .target_component = to.component.value,
                                    .type = static_cast<std::uint8_t>(result),
                                    .mission_type = static_cast<std::uint8_t>(type),
                                    .opaque_id = tells_id ? store_.id(type) : 0});
}

void MissionService::warn_once(bool& warned, std::string_view text, Speaker& speaker) const {
  if (is_px4() || warned) return;
  warned = true;
  speaker.say(messages::MAV_SEVERITY_WARNING, text);
}

void MissionService::on_count(Timestamp now, std::uint16_t count, PlanType type, Requester from, Speaker& speaker) {
  if (upload_ && !(upload_->from == from)) {
    const unsigned result = is_px4() ? messages::MAV_MISSION_ERROR : messages::MAV_MISSION_DENIED;
    return acknowledge(result, type, from, speaker);
  }
  const auto capacity = store_.capacity(type);
  if (count > capacity) {
    upload_.reset();
    acknowledge(messages::MAV_MISSION_NO_SPACE, type, from, speaker);
    std::array<char, 50> text{};
    const auto size = fmt::format_to_n(text.data(), text.size(), "Only {} items are supported", capacity).size;
    return speaker.say(messages::MAV_SEVERITY_WARNING, {text.data(), size});
  }
  if (!is_px4()) store_.truncate(type, count);
  begin(now,
        {.type = type,
         .from = from,
         .next = 0,
         .end = count,
         .asked = now,
         .heard = now,
         .in_integers = true,
         .is_partial = false},
        speaker);
}

/// Only ArduPilot's missions are overwritten in part.
void MissionService::on_write_partial(Timestamp now, std::int16_t first, std::int16_t last, PlanType type,
                                      Requester from, Speaker& speaker) {
  if (is_px4()) return;
  const auto count = static_cast<std::int32_t>(store_.items(type).size());
  if (upload_ || type != PlanType::mission || first < 0 || last < first || last >= count) {
    speaker.say(messages::MAV_SEVERITY_WARNING, "Flight plan update rejected");
    return acknowledge(messages::MAV_MISSION_ERROR, type, from, speaker);
  }
  begin(now,
        {.type = type,
         .from = from,
         .next = static_cast<std::uint16_t>(first),
         .end = static_cast<std::uint16_t>(last + 1),
         .asked = now,
         .heard = now,
         .in_integers = true,
         .is_partial = true},
        speaker);
}

void MissionService::begin(Timestamp now, const Upload& upload, Speaker& speaker) {
  upload_ = upload;
  staged_.clear();
  if (upload.next == upload.end) return finish(speaker);
  ask(now, speaker);
}

/// For the next item. ArduPilot asks with MISSION_REQUEST whatever the station sends.
void MissionService::ask(Timestamp now, Speaker& speaker) {
  upload_->asked = now;
  const auto fill = [&](auto request) {
    request.target_system = upload_->from.system.value;
    request.target_component = upload_->from.component.value;
    request.seq = upload_->next;
    request.mission_type = static_cast<std::uint8_t>(upload_->type);
    speaker.send(request);
  };
  if (is_px4() && upload_->in_integers) return fill(messages::MissionRequestInt{});
  fill(messages::MissionRequest{});
}

void MissionService::on_item(Timestamp now, const Item& item, bool in_integers, Requester from, Speaker& speaker) {
  const auto type = static_cast<PlanType>(item.mission_type);
  if (!upload_) {
    // PX4 takes the last item, once more, for a sign that its acknowledgement was lost.
    const bool is_last = is_px4() && done_ && done_->from == from && done_->type == type && item.seq + 1 == done_->end;
    return acknowledge(is_last ? messages::MAV_MISSION_ACCEPTED : messages::MAV_MISSION_ERROR, type, from, speaker);
  }
  if (!(upload_->from == from) || upload_->type != type) {
    if (!is_px4()) acknowledge(messages::MAV_MISSION_DENIED, type, from, speaker);
    return;
  }
  if (!in_integers) warn_once(warned_of_items_, "got MISSION_ITEM; GCS should send MISSION_ITEM_INT", speaker);
  upload_->heard = now;
  upload_->in_integers = in_integers;
  if (item.seq != upload_->next) {  // the transfer goes on
    if (!is_px4()) acknowledge(messages::MAV_MISSION_INVALID_SEQUENCE, type, from, speaker);
    return;
  }
  const auto stored = stored_item(personality_, type, item);
  if (!stored) {
    upload_.reset();
    return acknowledge(stored.error(), type, from, speaker);
  }
  if (is_px4())
    staged_.push_back(*stored);
  else
    store_.put(type, item.seq, *stored);
  if (++upload_->next == upload_->end) return finish(speaker);
  ask(now, speaker);
}

void MissionService::finish(Speaker& speaker) {
  const auto done = *upload_;
  done_ = upload_;
  upload_.reset();
  if (is_px4()) store_.replace(done.type, staged_);
  acknowledge(messages::MAV_MISSION_ACCEPTED, done.type, done.from, speaker);
  if (!is_px4())
    speaker.say(done.type == PlanType::fence ? messages::MAV_SEVERITY_DEBUG : messages::MAV_SEVERITY_INFO,
                received_text(done.type));
}

void MissionService::on_step(Timestamp now, Speaker& speaker) {
  if (!upload_) return;
  const auto patience = patience_of(personality_);
  if (now - upload_->heard >= patience.give_up) {
    const auto lost = *upload_;
    upload_.reset();
    if (is_px4()) return speaker.say(messages::MAV_SEVERITY_CRITICAL, "Operation timeout\t");
    acknowledge(messages::MAV_MISSION_OPERATION_CANCELLED, lost.type, lost.from, speaker);
    return speaker.say(messages::MAV_SEVERITY_WARNING, "Mission upload timeout");
  }
  if (now - upload_->asked >= patience.ask_again) ask(now, speaker);
}

void MissionService::on_request_list(PlanType type, Requester from, Speaker& speaker) {
  if (upload_) {
    if (!is_px4()) acknowledge(messages::MAV_MISSION_DENIED, type, from, speaker);
    return;
  }
  speaker.send(messages::MissionCount{.target_system = from.system.value,
                                      .target_component = from.component.value,
                                      .count = static_cast<std::uint16_t>(store_.items(type).size()),
                                      .mission_type = static_cast<std::uint8_t>(type),
                                      .opaque_id = is_px4() ? store_.id(type) : 0});
}

void MissionService::on_request(std::uint16_t sequence, PlanType type, bool in_integers, Requester from,
                                Speaker& speaker) {
  if (upload_) {
    if (!is_px4()) acknowledge(messages::MAV_MISSION_DENIED, type, from, speaker);
    return;
  }
  const auto items = store_.items(type);
  if (sequence >= items.size()) {
    if (is_px4()) return acknowledge(messages::MAV_MISSION_ERROR, type, from, speaker);
    on_request_list(type, from, speaker);
    return acknowledge(messages::MAV_MISSION_INVALID_SEQUENCE, type, from, speaker);
  }
  auto item = items[sequence];
  item.target_system = from.system.value;
  item.target_component = from.component.value;
  item.seq = sequence;
  item.mission_type = static_cast<std::uint8_t>(type);
  if (is_px4()) item.current = type == PlanType::mission && sequence == use_.current ? 1 : 0;
  if (in_integers) return speaker.send(item);
  speaker.send(to_floats(personality_, item));
  warn_once(warned_of_requests_, "got MISSION_REQUEST; use MISSION_REQUEST_INT!", speaker);
}

void MissionService::on_clear(std::uint8_t mission_type, Requester from, Speaker& speaker) {
  constexpr std::uint8_t all = messages::MAV_MISSION_TYPE_ALL;
  const auto type = plan_type(mission_type);
  if (!type && mission_type != all) return;
  const auto told = type.value_or(PlanType::mission);
  const bool is_mission = told == PlanType::mission;
  if (upload_ || (!is_px4() && is_mission && use_.runs)) {
    if (is_px4()) return speaker.say(messages::MAV_SEVERITY_CRITICAL, "WPM: CLEAR CMD IGNORED: Busy\t");
    return acknowledge(messages::MAV_MISSION_ERROR, told, from, speaker);
  }
  for (const auto each : {PlanType::mission, PlanType::fence, PlanType::rally})
    if (mission_type == all || each == told) store_.truncate(each, 0);
  acknowledge(messages::MAV_MISSION_ACCEPTED, told, from, speaker);
}

}  // namespace ponte::sim
