#pragma once

#include "common/failure.hpp"
#include "vehicle/operator.hpp"

#include <fmt/format.h>

namespace ponte::app {

/// Nothing of what happens meanwhile matters.
inline constexpr auto unheeded = [](const auto&) {};

/// All that the request needs is known.
inline constexpr auto never_early = [](auto) { return false; };

/// "MAV_RESULT_DENIED" of a refusal, "" of anything else.
template <class Fact>
std::string code_of(const Fact& fact) {
  return fact.kind == Fact::Kind::refused && fact.result != 0 ? result_name(fact.result) : std::string{};
}

/// The words, and what the vehicle said about it.
inline std::string with_reason(std::string_view words, std::string_view reason) {
  return reason.empty() ? std::string{words} : fmt::format("{} (\"{}\")", words, reason);
}

/// Whether plans and parameters are to be had as files, which the vehicle tells soon after it was found.
inline bool offers_files(Operator& station) {
  auto& client = station.client();
  (void)station.run_until([&] { return client.capabilities().has_value(); }, std::chrono::seconds{2});
  return client.offers_files();
}

/// What became of a request to the files.
template <class Begin>
autopilot::FileFact use_file(Operator& station, std::string_view action, Begin&& begin) {
  using autopilot::FileFact;
  const auto request = station.begin(action, begin, never_early);
  return station.await<FileFact>(
      [&](const FileFact& each) { return each.request == *request && each.kind != FileFact::Kind::progress; },
      unheeded);
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
