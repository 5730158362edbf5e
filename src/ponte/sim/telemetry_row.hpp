#pragma once

#include "ponte/sim/telemetry.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>

/// How the tables of telemetry are written: one function that makes a message, and the stream that it belongs to.
namespace ponte::sim {
namespace detail {

void send_made(const auto& message, FrameSender& sender, Outbox<Frame>& out) { sender.send(message, out); }

template <class M>
void send_made(const std::optional<M>& message, FrameSender& sender, Outbox<Frame>& out) {
  if (message) sender.send(*message, out);
}

template <class M>
struct Made {
  using type = M;
};
template <class M>
struct Made<std::optional<M>> {
  using type = M;
};

}  // namespace detail

/// The row of the message that `make` makes of a snapshot, or does not make yet.
template <auto make>
constexpr TelemetryRow telemetry_row(Stream stream) {
  using M = typename detail::Made<std::invoke_result_t<decltype(make), const Snapshot&>>::type;
  return {&M::info, stream, [](const Snapshot& snapshot, FrameSender& sender, Outbox<Frame>& out) {
            detail::send_made(make(snapshot), sender, out);
          }};
}

/// The streams of these rows.
template <std::size_t Size>
constexpr std::array<Stream, Size> streams_of(const std::array<TelemetryRow, Size>& rows) {
  std::array<Stream, Size> result{};
  std::transform(rows.begin(), rows.end(), result.begin(), [](const TelemetryRow& each) { return each.stream; });
  return result;
}

}  // namespace ponte::sim
