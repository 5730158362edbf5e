#pragma once

#include "ponte/core/time.hpp"
#include "ponte/dli/entity_id.hpp"
#include "ponte/dli/message_info.hpp"
#include "ponte/dli/profile.hpp"
#include "ponte/dli/scale.hpp"
#include "ponte/dli/time.hpp"
#include "ponte/vehicle/state.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>

/// The mapping vehicle -> DLI as rows: which facts become which field of which message, by which rule. The code that
/// builds messages, the documentation and the tests are all made from the same rows.
namespace ponte::dlisession {

/// What the configuration says of a vehicle.
struct VehicleDescription {
  dli::EntityId vsm;
  dli::EntityId vehicle;
  std::uint16_t vehicle_type{};                    ///< of the standard's table; 0: not identified
  std::optional<std::uint16_t> vehicle_subtype{};  ///< nothing: the autopilot's MAV_TYPE
  Text<15> tail_number{};                          ///< empty: the autopilot's serial number
  Text<31> call_sign{};
};

struct MappingContext {
  const dli::Profile& profile;
  const VehicleDescription& description;
};

/// How facts become a field, in words and in code. The function takes the facts' values, with a `MappingContext` before
/// them if it wants one, and returns nothing where the field has to be absent. A quantity is scaled as the profile
/// says.
template <class F>
struct Rule {
  std::string_view text;
  F convert;
};
template <class F>
Rule(std::string_view, F) -> Rule<F>;

template <dli::Message M, class Raw, class F, class Source, class... Members>
struct Row {
  std::optional<Raw> M::*target;
  const dli::FieldInfo* field;  ///< of the target
  Rule<F> rule;
  std::string_view reference;  ///< of the design document that the row follows
  std::tuple<Members Source::*...> sources;
};

namespace detail {

/// The description of a message's member.
template <dli::Message M, class Raw>
constexpr const dli::FieldInfo* field_of(std::optional<Raw> M::*member) {
  const M message{};
  const dli::FieldInfo* found = nullptr;
  M::visit(message, [&]<class T>(const dli::FieldInfo& field, const T& value) {
    if constexpr (std::same_as<T, std::optional<Raw>>)
      if (&value == &(message.*member)) found = &field;
  });
  return found;
}

template <class T>
bool is_known(const vehicle::Fact<T>& fact) {
  return fact.known();
}
template <class T>
bool is_known(const T&) {
  return true;
}
template <class T>
bool is_news(const vehicle::Fact<T>& fact, vehicle::Revision since) {
  return fact.newer_than(since);
}
template <class T>
bool is_news(const T&, vehicle::Revision) {
  return true;
}
template <class T>
const T& value_of(const vehicle::Fact<T>& fact) {
  return fact.value();
}
template <class T>
const T& value_of(const T& value) {
  return value;
}
template <class T>
void advance(WallTime& newest, const vehicle::Fact<T>& fact) {
  newest = std::max(newest, fact.at());
}
template <class T>
void advance(WallTime&, const T&) {}

/// The wire's integer for a physical value; nothing when the value does not fit, rather than a wrong one.
template <dli::Message M, class Raw, class Unit>
std::optional<Raw> raw_from(Quantity<Unit> value, const dli::FieldInfo& field, const dli::Profile& profile) {
  const auto scaled = dli::raw_from_value(field, profile.scale_of(M::info, field), value.value);
  if (!scaled || scaled->saturated) return std::nullopt;
  return static_cast<Raw>(scaled->raw);
}
template <dli::Message M, class Raw>
std::optional<Raw> raw_from(WallTime value, const dli::FieldInfo&, const dli::Profile&) {
  return dli::time_stamp_from(value);
}
template <dli::Message M, class Raw, std::size_t Size>
std::optional<Raw> raw_from(const Text<Size>& value, const dli::FieldInfo&, const dli::Profile&) {
  return Raw{value.view()};
}
template <dli::Message M, std::integral Raw>
std::optional<Raw> raw_from(Raw value, const dli::FieldInfo&, const dli::Profile&) {
  return value;
}

}  // namespace detail

template <dli::Message M, class Raw, class F, class Source, class... Members>
constexpr auto row(std::optional<Raw> M::*target, Rule<F> rule, std::string_view reference,
                   Members Source::*... sources) {
  return Row<M, Raw, F, Source, Members...>{target, detail::field_of(target), rule, reference, {sources...}};
}

/// A message and the time its newest fact was true.
template <dli::Message M>
struct Built {
  M message{};
  WallTime at{};
};

/// The message with every field that a row of `table` can tell and that is news since `since` (0: everything), its time
/// stamp set. Nothing when there is no news. `at` is the earliest that the time stamp can be: for sources without
/// times.
template <class M, class Table, class Source>
[[nodiscard]] std::optional<Built<M>> build(const Table& table, const Source& source, vehicle::Revision since,
                                            WallTime at, const MappingContext& context) {
  Built<M> built{.message = {}, .at = at};
  bool has_news = false;
  const auto fill = [&]<class Raw, class F, class... Members>(const Row<M, Raw, F, Source, Members...>& row) {
    std::apply(
        [&](auto... member) {
          if (built.message.*row.target) return;
          if (!(detail::is_known(source.*member) && ...)) return;
          if (!(detail::is_news(source.*member, since) || ...)) return;
          const auto assign = [&](const auto& value) {
            if (!value) return;
            built.message.*row.target = detail::raw_from<M, Raw>(*value, *row.field, context.profile);
            if (!(built.message.*row.target)) return;
            has_news = true;
            (detail::advance(built.at, source.*member), ...);
          };
          if constexpr (std::invocable<F, const MappingContext&, decltype(detail::value_of(source.*member))...>)
            assign(row.rule.convert(context, detail::value_of(source.*member)...));
          else
            assign(row.rule.convert(detail::value_of(source.*member)...));
        },
        row.sources);
  };
  std::apply([&](const auto&... row) { (fill(row), ...); }, table);
  if (!has_news) return std::nullopt;
  built.message.time_stamp = dli::time_stamp_from(built.at);
  return built;
}

/// A row in words.
struct RowText {
  const dli::MessageInfo* message;
  const dli::FieldInfo* field;
  std::array<std::string_view, 4> sources;  ///< the unused ones are empty
  std::array<std::string_view, 4> units;    ///< of the sources
  std::string_view rule;
  std::string_view reference;
};

template <class T>
[[nodiscard]] constexpr std::string_view name_of_source(vehicle::FactOf<T> fact) {
  return vehicle::name_of(fact);
}
template <class T>
[[nodiscard]] constexpr std::string_view unit_of_source(vehicle::FactOf<T>) {
  return vehicle::unit_symbol<T>();
}

template <dli::Message M, class Raw, class F, class Source, class... Members>
[[nodiscard]] RowText describe(const Row<M, Raw, F, Source, Members...>& row) {
  static_assert(sizeof...(Members) <= std::tuple_size_v<decltype(RowText::sources)>);
  RowText text{.message = &M::info,
               .field = row.field,
               .sources = {},
               .units = {},
               .rule = row.rule.text,
               .reference = row.reference};
  std::size_t count = 0;
  const auto add = [&](auto member) {
    text.sources[count] = name_of_source(member);
    text.units[count++] = unit_of_source(member);
  };
  std::apply([&](auto... member) { (add(member), ...); }, row.sources);
  return text;
}

}  // namespace ponte::dlisession
