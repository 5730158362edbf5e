#pragma once

#include "ponte/sim/airframe.hpp"
#include "ponte/sim/personality.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace ponte::sim {

/// MAV_PARAM_TYPE, as far as the two autopilots use it.
enum class ParameterType : std::uint8_t { int8 = 2, int16 = 4, int32 = 6, real32 = 9 };

struct ParameterInfo {
  std::string_view name;  ///< at most 16 characters
  ParameterType type;
  double default_value;
};

/// What an autopilot has.
struct ParameterTable {
  std::vector<ParameterInfo> rows;   ///< in the order of its list
  std::vector<std::size_t> by_name;  ///< indices of the rows, by their names
};

/// Names, types and defaults are the real ones. PX4 has those of all airframes; what a real ArduPlane has and is not
/// known is not in its table.
[[nodiscard]] const ParameterTable& parameter_table(Personality personality, AirframeType type);

/// The parameters of one autopilot and their values, in the units of the autopilot. Whether a value makes sense is not
/// examined, as on the real ones; that it fits its type is.
class Parameters {
 public:
  explicit Parameters(Personality personality, AirframeType type = AirframeType::copter);

  [[nodiscard]] std::size_t size() const { return values_.size(); }
  /// The index of the parameter of this name, or nothing.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;
  [[nodiscard]] const ParameterInfo& info(std::size_t index) const { return table_.rows[index]; }
  [[nodiscard]] double value(std::size_t index) const { return values_[index]; }
  /// As its type holds it.
  [[nodiscard]] double default_value(std::size_t index) const;
  /// Of a parameter that this personality has: another name is a mistake of the caller's.
  [[nodiscard]] double value(std::string_view name) const;

  /// Counts the changes.
  [[nodiscard]] std::uint32_t changes() const { return changes_; }
  /// Takes a finite value, rounded and limited to the type.
  void set(std::size_t index, double value);
  /// As the other `value`, for what the autopilot itself sets.
  void set(std::string_view name, double value);

 private:
  const ParameterTable& table_;
  std::vector<double> values_;
  std::uint32_t changes_{};
};

}  // namespace ponte::sim
