#pragma once

#include "ponte/autopilot/parameter.hpp"
#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Parameters as ground stations save them: QGroundControl's `.params` (tab separated: vehicle, component, name, value,
/// MAV_PARAM_TYPE) and MAVProxy's `.parm` (name and value). Lines that begin with `#`, and what follows a `#`, are
/// comments in both. A file of bytes goes in and text comes out; no file is opened here.
namespace ponte::autopilot {

/// One line. MAVProxy's files have the name and the value only.
struct ParameterLine {
  std::size_t line{};  ///< from 1
  std::optional<std::uint8_t> system{};
  std::optional<std::uint8_t> component{};
  ParameterName name{};
  double value{};
  std::optional<ParameterType> type{};
  friend bool operator==(const ParameterLine&, const ParameterLine&) = default;
};

/// For a message such as "line 7: the value is 'x': expected a number".
struct ParameterFileError {
  std::size_t line{};
  std::string what{};         ///< e.g. "the value is 'x'"
  std::string expectation{};  ///< completes "expected ..."
  friend bool operator==(const ParameterFileError&, const ParameterFileError&) = default;
};

/// Either format, told by the number of fields in a line. A name that comes twice is refused.
[[nodiscard]] Result<std::vector<ParameterLine>, ParameterFileError> read_parameter_file(Bytes file);

/// In QGroundControl's format, as parameters of this component.
[[nodiscard]] std::string write_qgroundcontrol_file(std::span<const Parameter> parameters, std::uint8_t system,
                                                    std::uint8_t component);
/// In MAVProxy's format.
[[nodiscard]] std::string write_mavproxy_file(std::span<const Parameter> parameters);

}  // namespace ponte::autopilot
