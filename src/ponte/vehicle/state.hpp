#pragma once

#include "ponte/vehicle/fact.hpp"
#include "ponte/vehicle/vocabulary.hpp"

#include <array>
#include <string_view>
#include <type_traits>

namespace ponte::vehicle {

/// All that is known of one vehicle. What is not known stays unknown: there is no zero that means nothing.
struct State {
#define PONTE_FACT(name, type, meaning) Fact<type> name{};
#include "ponte/vehicle/facts.def"
#undef PONTE_FACT

  std::array<Fact<Condition>, subsystem_count> subsystems{};

  /// Of the newest change; 0: nothing was ever learnt.
  Revision revision{};
};

template <class T>
using FactOf = Fact<T> State::*;

/// The unit of a fact's type, empty where it has none.
template <class T>
constexpr std::string_view unit_symbol() {
  if constexpr (requires { typename T::unit; })
    return T::unit::symbol;
  else
    return "";
}

/// Calls `visitor(member pointer, name, unit, meaning)` for every fact but the subsystems.
template <class Visitor>
constexpr void visit_facts(Visitor&& visitor) {
#define PONTE_FACT(name, type, meaning) \
  visitor(&State::name, std::string_view{#name}, unit_symbol<type>(), std::string_view{meaning});
#include "ponte/vehicle/facts.def"
#undef PONTE_FACT
}

/// The name of a fact, for documentation.
template <class T>
[[nodiscard]] constexpr std::string_view name_of(FactOf<T> wanted) {
  std::string_view result;
  visit_facts([&]<class U>(FactOf<U> fact, std::string_view name, std::string_view, std::string_view) {
    if constexpr (std::is_same_v<T, U>)
      if (fact == wanted) result = name;
  });
  return result;
}

}  // namespace ponte::vehicle
