#pragma once

#include "common/failure.hpp"
#include "vehicle/operator.hpp"

#include <fmt/format.h>

namespace ponte::app {

/// Nothing of what happens meanwhile matters.
inline constexpr auto unheeded = [](const auto&) {};

/// "MAV_RESULT_DENIED" of a refusal, "" of anything else.
template <class Fact>
std::string code_of(const Fact& fact) {
  return fact.kind == Fact::Kind::refused && fact.result != 0 ? result_name(fact.result) : std::string{};
}

/// The words, and what the vehicle said about it.
inline std::string with_reason(std::string_view words, std::string_view reason) {
  return reason.empty() ? std::string{words} : fmt::format("{} (\"{}\")", words, reason);
}

/// Wishes something of a service, and waits until it is done. Throws `Failure` if it is not.
template <class Wish, class Begin, class IsEarly>
void carry_out(Operator& station, std::string_view action, Begin&& begin, IsEarly&& is_early) {
  using Fact = autopilot::WishFact<Wish>;
  const auto request = station.begin(action, begin, is_early);
  const auto fact = station.await<Fact>([&](const Fact& each) { return each.request == *request; }, unheeded);
  if (fact.kind == Fact::Kind::done) return station.tell_done(action);
  station.give_up(action, code_of(fact), with_reason(to_text_of_wish<Wish>(fact.kind), fact.reason.view()));
}

}  // namespace ponte::app
