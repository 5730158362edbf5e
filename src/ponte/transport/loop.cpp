#include "ponte/transport/loop.hpp"

#include "ponte/transport/asio.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>

namespace ponte::transport {

using std::chrono::steady_clock;

struct Loop::Impl {
  /// One thread runs the loop; others may post.
  static constexpr int thread_count = 1;

  steady_clock::time_point start = steady_clock::now();
  asio::io_context context{thread_count};
  asio::executor_work_guard<asio::io_context::executor_type> work{context.get_executor()};
  asio::signal_set signals{context};
  std::function<void(int)> on_signal{};

  void wait_for_signal() {
    signals.async_wait([this](error_code error, int signal) {
      if (error) return;
      wait_for_signal();
      on_signal(signal);
    });
  }

  /// A stop counts for one run only.
  void forget_stop() {
    if (context.stopped()) context.restart();
  }
};

Loop::Loop() : impl_{std::make_unique<Impl>()} {}
Loop::~Loop() = default;

Timestamp Loop::now() const { return Timestamp{steady_clock::now() - impl_->start}; }

WallTime Loop::wall() { return std::chrono::time_point_cast<WallTime::duration>(std::chrono::system_clock::now()); }

void Loop::run() {
  impl_->context.run();
  impl_->forget_stop();
}

void Loop::run_for(Duration limit) {
  impl_->context.run_for(limit);
  impl_->forget_stop();
}

bool Loop::run_until(const std::function<bool()>& reached, Duration limit) {
  const auto deadline = steady_clock::now() + limit;
  auto is_reached = reached();
  while (!is_reached && impl_->context.run_one_until(deadline) > 0) is_reached = reached();
  impl_->forget_stop();
  return is_reached;
}

void Loop::stop() { impl_->context.stop(); }

void Loop::post(std::function<void()> work) { asio::post(impl_->context, std::move(work)); }

void Loop::on_signal(std::function<void(int signal)> callback) {
  const auto is_waiting = static_cast<bool>(impl_->on_signal);
  impl_->on_signal = std::move(callback);
  if (is_waiting) return;
  impl_->signals.add(SIGINT);
  impl_->signals.add(SIGTERM);
  impl_->wait_for_signal();
}

boost::asio::io_context& Loop::context() { return impl_->context; }

/// Shared with the wait in progress, which may come to its end after the timer has gone.
struct Timer::State : std::enable_shared_from_this<Timer::State> {
  State(Loop& its_loop, std::function<void(Timestamp)> its_callback)
      : loop{its_loop}, timer{its_loop.context()}, callback{std::move(its_callback)} {}

  // A deadline that moves back, as it does with every packet, costs nothing: the wait in progress ends at the earlier
  // time and is then prolonged.
  void set(Timestamp when) {
    due = when;
    if (!waits_until || when < *waits_until) wait_until(when);
  }

  void wait_until(Timestamp when) {
    static constexpr auto longest = std::chrono::hours{24};  // keeps sums away from the end of time
    const auto now = loop.now();
    waits_until = std::clamp<Timestamp>(when, now, now + longest);
    timer.expires_after(*waits_until - now);
    auto on_end = [self = shared_from_this(), turn = ++turns](error_code) { self->on_end(turn); };
    timer.async_wait(std::move(on_end));
  }

  void on_end(std::uint64_t turn) {
    if (turn != turns) return;  // replaced meanwhile
    waits_until.reset();
    if (!due) return;
    const auto now = loop.now();
    if (*due > now) return wait_until(*due);
    due.reset();
    callback(now);
  }

  void end() {
    due.reset();
    ++turns;
    error_code ignored;
    timer.cancel(ignored);
  }

  Loop& loop;
  asio::steady_timer timer;
  std::function<void(Timestamp)> callback;
  std::optional<Timestamp> due{};
  std::optional<Timestamp> waits_until{};
  std::uint64_t turns{};
};

Timer::Timer(Loop& loop, std::function<void(Timestamp now)> callback)
    : state_{std::make_shared<State>(loop, std::move(callback))} {}

Timer::~Timer() { state_->end(); }

void Timer::set(Timestamp due) { state_->set(due); }

void Timer::set(std::optional<Timestamp> due) { due ? set(*due) : clear(); }

void Timer::clear() { state_->due.reset(); }

std::optional<Timestamp> Timer::due() const { return state_->due; }

}  // namespace ponte::transport
