#include "ponte/sim/parameter_service.hpp"

#include "ponte/mavlink/autopilots/param_error.hpp"
#include "ponte/mavlink/autopilots/param_value.hpp"

#include <boost/crc.hpp>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

constexpr std::size_t repeats_per_step = 10;
constexpr Duration read_interval = std::chrono::milliseconds{100};  // at which ArduPilot looks at its queue of requests
constexpr std::uint16_t no_index = 65535;
constexpr std::string_view hash_name = "_HASH_CHECK";
constexpr std::uint8_t type_uint32 = 5;  // MAV_PARAM_TYPE

// MAV_PARAM_ERROR
constexpr std::uint8_t does_not_exist = 1;
constexpr std::uint8_t value_out_of_range = 2;
constexpr std::uint8_t type_mismatch = 7;

std::size_t list_items_per_step(std::optional<std::size_t> line_rate) {
  if (!line_rate) return 32;
  constexpr auto steps_per_second = std::chrono::seconds{1} / Airframe::step_length;
  constexpr auto item_size =
      mavlink::header_size(mavlink::Version::v2) + messages::ParamValue::info.full_length + sizeof(std::uint16_t);
  return std::max<std::size_t>(1, *line_rate / 3 / steps_per_second / item_size);
}

}  // namespace

ParameterService::ParameterService(Personality personality, Parameters& parameters,
                                   std::optional<std::size_t> line_rate)
    : personality_{personality},
      parameters_{parameters},
      list_items_per_step_{list_items_per_step(line_rate)},
      next_of_list_{parameters.size()},
      repeats_(parameters.size()) {}

/// Of every name and every value of four bytes, with nothing done to the register before or after.
std::uint32_t ParameterService::hash() const {
  boost::crc_optimal<32, 0x04C11DB7, 0, 0, true, true> crc;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const auto name = parameters_.info(i).name;
    crc.process_bytes(name.data(), name.size());
    const float value = encoded(i);
    crc.process_bytes(&value, sizeof value);
  }
  return crc.checksum();
}

float ParameterService::encoded(std::size_t parameter) const {
  const double value = parameters_.value(parameter);
  if (!is_px4() || parameters_.info(parameter).type == ParameterType::real32) return static_cast<float>(value);
  return std::bit_cast<float>(static_cast<std::int32_t>(value));
}

void ParameterService::send(std::size_t parameter, std::uint16_t told_index, Speaker& speaker) const {
  const auto& info = parameters_.info(parameter);
  speaker.send(messages::ParamValue{.param_id = info.name,
                                    .param_value = encoded(parameter),
                                    .param_type = static_cast<std::uint8_t>(info.type),
                                    .param_count = static_cast<std::uint16_t>(parameters_.size()),
                                    .param_index = told_index});
}

void ParameterService::send_hash(Speaker& speaker) const {
  speaker.send(messages::ParamValue{.param_id = hash_name,
                                    .param_value = std::bit_cast<float>(hash()),
                                    .param_type = type_uint32,
                                    .param_count = static_cast<std::uint16_t>(parameters_.size()),
                                    .param_index = no_index});
}

void ParameterService::refuse(std::string_view name, std::uint8_t error, Requester requester, Speaker& speaker) const {
  speaker.send(messages::ParamError{.target_system = requester.system.value,
                                    .target_component = requester.component.value,
                                    .param_id = name,
                                    .param_index = -1,
                                    .error = error});
}

void ParameterService::on_request_list() { next_of_list_ = 0; }

void ParameterService::on_request_read(const messages::ParamRequestRead& request, Requester requester,
                                       Speaker& speaker) {
  const auto name = request.param_id.view();
  if (is_px4() && request.param_index < 0 && name == hash_name) return send_hash(speaker);

  const auto by_index = static_cast<std::size_t>(request.param_index);
  const auto found = request.param_index < 0         ? parameters_.find(name)
                     : by_index < parameters_.size() ? std::optional{by_index}
                                                     : std::nullopt;
  if (is_px4()) {
    if (!found) return refuse(name, does_not_exist, requester, speaker);
    return send(*found, static_cast<std::uint16_t>(*found), speaker);
  }
  if (!found || waiting_reads_ == reads_.size()) return;
  const auto told_index = request.param_index < 0 ? no_index : static_cast<std::uint16_t>(by_index);
  reads_[waiting_reads_++] = {*found, told_index};
}

void ParameterService::on_set(const messages::ParamSet& wish, Requester requester, Speaker& speaker) {
  const auto name = wish.param_id.view();
  const auto found = parameters_.find(name);
  if (is_px4()) {
    if (name == hash_name) {  // the station knows everything already
      if (std::bit_cast<std::uint32_t>(wish.param_value) == hash()) next_of_list_ = parameters_.size();
    } else if (!found) {
      refuse(name, does_not_exist, requester, speaker);
    } else {
      set_px4(*found, wish, requester, speaker);
    }
    return;
  }
  if (!found || !std::isfinite(wish.param_value)) return;
  parameters_.set(*found, double{wish.param_value});  // whatever the type says
  send(*found, no_index, speaker);
}

void ParameterService::set_px4(std::size_t parameter, const messages::ParamSet& wish, Requester requester,
                               Speaker& speaker) {
  const auto& info = parameters_.info(parameter);
  if (wish.param_type != static_cast<std::uint8_t>(info.type))
    return refuse(info.name, type_mismatch, requester, speaker);
  if (info.type != ParameterType::real32)
    parameters_.set(parameter, std::bit_cast<std::int32_t>(wish.param_value));
  else if (std::isfinite(wish.param_value))
    parameters_.set(parameter, double{wish.param_value});
  else
    return refuse(info.name, value_out_of_range, requester, speaker);
  send(parameter, static_cast<std::uint16_t>(parameter), speaker);
  if (!repeats_[parameter]) ++waiting_repeats_;
  repeats_[parameter] = true;
}

void ParameterService::on_step(Duration since_boot, Speaker& speaker) {
  if (is_px4() && next_of_list_ == 0) send_hash(speaker);
  for (std::size_t sent = 0; next_of_list_ < parameters_.size() && sent < list_items_per_step_; ++sent, ++next_of_list_)
    send(next_of_list_, static_cast<std::uint16_t>(next_of_list_), speaker);

  if (since_boot % read_interval == Duration{}) {
    for (const auto& each : std::span{reads_}.first(waiting_reads_)) send(each.parameter, each.told_index, speaker);
    waiting_reads_ = 0;
  }
  auto repeats = std::min(waiting_repeats_, repeats_per_step);
  waiting_repeats_ -= repeats;
  for (std::size_t i = 0; repeats > 0; ++i) {
    if (!repeats_[i]) continue;
    send(i, static_cast<std::uint16_t>(i), speaker);
    repeats_[i] = false;
    --repeats;
  }
}

void ParameterService::announce(std::string_view name, double value, Speaker& speaker) {
  const auto found = parameters_.find(name);
  if (!found || parameters_.value(*found) == value) return;
  parameters_.set(*found, value);
  send(*found, no_index, speaker);
}

}  // namespace ponte::sim
