#pragma once

#include "ponte/vehicle/vocabulary.hpp"

#include <cstdint>
#include <string_view>
#include <type_traits>

/// What is reported one message per event or subsystem, beside the vehicle's state.
namespace ponte::dlisession {

struct AlertReport {
  vehicle::Condition severity{};
  vehicle::Subsystem subsystem{};
  Text<79> text;
  std::int32_t id{};  ///< negative the first time, see `AlertIds`
};

struct SubsystemReport {
  vehicle::Subsystem subsystem{};
  vehicle::Condition condition{};
};

template <class T>
[[nodiscard]] constexpr std::string_view name_of_source(T AlertReport::*member) {
  if constexpr (std::is_same_v<T, vehicle::Condition>) return member == &AlertReport::severity ? "alert severity" : "";
  if constexpr (std::is_same_v<T, vehicle::Subsystem>)
    return member == &AlertReport::subsystem ? "alert subsystem" : "";
  if constexpr (std::is_same_v<T, Text<79>>) return member == &AlertReport::text ? "alert text" : "";
  if constexpr (std::is_same_v<T, std::int32_t>) return member == &AlertReport::id ? "alert id" : "";
}

template <class T>
[[nodiscard]] constexpr std::string_view name_of_source(T SubsystemReport::*member) {
  if constexpr (std::is_same_v<T, vehicle::Subsystem>) return member == &SubsystemReport::subsystem ? "subsystem" : "";
  if constexpr (std::is_same_v<T, vehicle::Condition>)
    return member == &SubsystemReport::condition ? "condition of the subsystem" : "";
}

template <class T>
[[nodiscard]] constexpr std::string_view unit_of_source(T AlertReport::*) {
  return "";
}
template <class T>
[[nodiscard]] constexpr std::string_view unit_of_source(T SubsystemReport::*) {
  return "";
}

}  // namespace ponte::dlisession
