#pragma once

#include "ponte/mavlink/message_info.hpp"
#include "ponte/vehicle/state.hpp"

#include <array>
#include <concepts>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

/// The mapping MAVLink -> vehicle as rows: which fields of which message, by which rule, tell which fact. The code that
/// updates a `vehicle::State`, the documentation and the tests are all made from the same rows.
namespace ponte::autopilot {

/// What a rule may look at beside the fields of its message.
struct MappingContext {
  const vehicle::State& state;
  WallTime at;  ///< when the message was true at the source
};

/// How fields become a fact, in words and in code. The function takes the fields' values, with a `MappingContext`
/// before them if it wants one, and returns nothing where they say nothing.
template <class F>
struct Rule {
  std::string_view text;
  F convert;
};
template <class F>
Rule(std::string_view, F) -> Rule<F>;

template <mavlink::Message M, class T, class F, class... Fields>
struct Row {
  vehicle::FactOf<T> target;
  Rule<F> rule;
  std::string_view reference;  ///< of the design document that the row follows
  vehicle::SourceRank rank;
  std::tuple<Fields M::*...> sources;

  [[nodiscard]] std::optional<T> convert(const M& message, const MappingContext& context) const {
    return std::apply(
        [&](auto... source) -> std::optional<T> {
          if constexpr (std::invocable<F, const MappingContext&, const Fields&...>)
            return rule.convert(context, message.*source...);
          else
            return rule.convert(message.*source...);
        },
        sources);
  }
};

template <mavlink::Message M, class T, class F, class... Fields>
constexpr auto row(vehicle::FactOf<T> target, Rule<F> rule, std::string_view reference, vehicle::SourceRank rank,
                   Fields M::*... sources) {
  return Row<M, T, F, Fields...>{target, rule, reference, rank, {sources...}};
}

/// Facts from the best source there is.
template <mavlink::Message M, class T, class F, class First, class... Fields>
constexpr auto row(vehicle::FactOf<T> target, Rule<F> rule, std::string_view reference, First M::*first,
                   Fields M::*... sources) {
  return row(target, rule, reference, vehicle::SourceRank{0}, first, sources...);
}

/// A row in words.
struct RowText {
  std::string_view message;
  std::array<std::string_view, 8> sources;  ///< the unused ones are empty
  std::string_view rule;
  std::string_view target;
  std::string_view unit;
  std::string_view reference;
  vehicle::SourceRank rank;
};

template <mavlink::Message M, class T, class F, class... Fields>
[[nodiscard]] RowText describe(const Row<M, T, F, Fields...>& row) {
  static_assert(sizeof...(Fields) <= std::tuple_size_v<decltype(RowText::sources)>);
  RowText text{.message = M::info.name,
               .sources = {},
               .rule = row.rule.text,
               .target = vehicle::name_of(row.target),
               .unit = vehicle::unit_symbol<T>(),
               .reference = row.reference,
               .rank = row.rank};
  const M message{};
  std::size_t count = 0;
  const auto name_source = [&](auto source) {
    M::visit(message, [&](const mavlink::FieldInfo& field, const auto& member) {
      if (static_cast<const void*>(&member) == static_cast<const void*>(&(message.*source)))
        text.sources[count] = field.name;
    });
    ++count;
  };
  std::apply([&](auto... source) { (name_source(source), ...); }, row.sources);
  return text;
}

}  // namespace ponte::autopilot
