#pragma once

#include "ponte/core/time.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace boost::asio {
class io_context;
}

namespace ponte::transport {

/// What the program does between events: it waits for sockets, ports and timers, and calls back. One thread runs it,
/// and every callback comes on that thread. It outlives the timers and links that are on it.
///
/// An exception in a callback leaves the function that runs the loop.
class Loop {
 public:
  Loop();
  ~Loop();
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  /// Since the loop began; never goes back. Any thread may ask.
  [[nodiscard]] Timestamp now() const;
  /// Of the system's clock, which may be set while we run. Any thread may ask.
  [[nodiscard]] static WallTime wall();

  /// Runs until `stop`.
  void run();
  /// Runs for that long, or until `stop`.
  void run_for(Duration limit);
  /// Runs until `reached()`, which is asked at first and after every event, or until the limit or `stop`. Returns
  /// whether it was reached.
  [[nodiscard]] bool run_until(const std::function<bool()>& reached, Duration limit);
  /// Ends the run in progress, or the next one at once if there is none. Any thread may call it.
  void stop();

  /// Does `work` soon, on the loop's thread. Any thread may call it.
  void post(std::function<void()> work);
  /// From now on SIGINT and SIGTERM no longer end the program; they call `callback` with their number, however often
  /// they come.
  void on_signal(std::function<void(int signal)> callback);

  /// For those who include ponte/transport/asio.hpp.
  [[nodiscard]] boost::asio::io_context& context();

 private:
  struct Impl;

  std::unique_ptr<Impl> impl_;
};

/// Calls back once, at or after a time, and may be set again whenever one likes.
class Timer {
 public:
  /// `callback` is given the time at which it is called. It may set or destroy the timer.
  Timer(Loop& loop, std::function<void(Timestamp now)> callback);
  /// Clears it: no call comes any more.
  ~Timer();
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

  /// Replaces what was set before. A time in the past is due at once, though never within this call.
  void set(Timestamp due);
  /// The same; nothing clears it. Fits the `next_deadline` of engines.
  void set(std::optional<Timestamp> due);
  void clear();
  [[nodiscard]] std::optional<Timestamp> due() const;

 private:
  struct State;

  std::shared_ptr<State> state_;
};

}  // namespace ponte::transport
