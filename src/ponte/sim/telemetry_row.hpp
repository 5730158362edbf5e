#pragma once

#include "ponte/sim/telemetry.hpp"

#include <optional>
#include <type_traits>

/// How the tables of telemetry are written: one function that makes a message, and when it is sent.
namespace ponte::sim {
namespace detail {

void send_made(const auto& message, mavlink::FrameSender& sender, Outbox<mavlink::FrameBuffer>& out) {
  sender.send(message, out);
}

template <class M>
void send_made(const std::optional<M>& message, mavlink::FrameSender& sender, Outbox<mavlink::FrameBuffer>& out) {
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
constexpr TelemetryRow telemetry_row(Rate rate) {
  using M = typename detail::Made<std::invoke_result_t<decltype(make), const Snapshot&>>::type;
  return {&M::info, rate,
          [](const Snapshot& snapshot, mavlink::FrameSender& sender, Outbox<mavlink::FrameBuffer>& out) {
            detail::send_made(make(snapshot), sender, out);
          }};
}

}  // namespace ponte::sim
