#include "sim/vehicle_options.hpp"

#include "common/failure.hpp"
#include "common/number_list.hpp"
#include "ponte/sim/parameters.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

namespace ponte::app {
sim::Position position_from(const std::string& text) {
  const auto numbers = numbers_in(text, 3, 3);
  if (!numbers) throw UsageError{fmt::format("--home {}: expected LAT,LON,ALT in degrees and metres", text)};
  const double latitude = (*numbers)[0];
  const double longitude = (*numbers)[1];
  const double altitude = (*numbers)[2];
  if (!(std::abs(latitude) <= 85 && std::abs(longitude) <= 180 && std::abs(altitude) <= 10'000))
    throw UsageError{
        fmt::format("--home {}: expected a latitude of at most 85, a longitude of at most 180 and an "
                    "altitude of at most 10000",
                    text)};
  return {radians_from_degrees(latitude), radians_from_degrees(longitude), Metres{altitude}};
}

sim::WindConfig wind_from(const std::string& text) {
  const auto numbers = numbers_in(text, 2, 3);
  if (!numbers || (*numbers)[0] < 0 || (*numbers)[0] > 60 || std::abs((*numbers)[1]) > 360)
    throw UsageError{
        fmt::format("--wind {}: expected SPEED,FROM[,GUSTS]: at most 60 m/s, degrees, and a share of the "
                    "speed, as in 6,270,0.2",
                    text)};
  const double gusts = numbers->size() > 2 ? (*numbers)[2] : 0;
  if (!(gusts >= 0 && gusts <= 1)) throw UsageError{fmt::format("--wind {}: expected gusts from 0 to 1", text)};
  return {.speed = MetresPerSecond{(*numbers)[0]}, .from = radians_from_degrees((*numbers)[1]), .gusts = gusts};
}

sim::ParameterSetting setting_from(const std::string& text, const sim::VehicleConfig& config) {
  const auto equals = text.find('=');
  const auto name = text.substr(0, equals);
  sim::ParameterSetting setting{.name = name};
  const char* const end = text.data() + text.size();
  const char* const at = equals == std::string::npos ? end : text.data() + equals + 1;
  const auto [after, error] = std::from_chars(at, end, setting.value);
  if (error != std::errc{} || after != end || !std::isfinite(setting.value))
    throw UsageError{fmt::format("--param {}: expected NAME=NUMBER", text)};
  if (!sim::Parameters{config.personality, config.type}.find(name))
    throw UsageError{fmt::format("--param {}: this autopilot has no parameter {}", text, name)};
  return setting;
}

bool take_target(std::string_view& text, unsigned system) {
  unsigned target{};
  const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), target);
  if (error != std::errc{} || after == text.data() + text.size() || *after != ':') return true;
  text.remove_prefix(static_cast<std::size_t>(after - text.data()) + 1);
  return target == system;
}

std::vector<sim::Fault> faults_from(const std::vector<std::string>& texts, unsigned system) {
  std::vector<sim::Fault> result;
  for (const auto& text : texts) {
    std::string_view rest = text;
    const bool is_meant = take_target(rest, system);
    const auto faults = sim::parse_faults(rest);
    if (!faults) throw UsageError{"--fault " + faults.error()};
    if (is_meant) result.insert(result.end(), faults->begin(), faults->end());
  }
  return result;
}

}  // namespace ponte::app
