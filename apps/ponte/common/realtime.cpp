#include "common/realtime.hpp"

#include "common/failure.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

namespace ponte::app {
namespace {

constexpr std::size_t page_size = 4096;  // or larger, then some pages are touched twice
constexpr std::size_t heap_reserve = 8U << 20U;
constexpr std::size_t stack_reserve = 256U << 10U;

template <class Memory>
void touch_pages(Memory& memory, std::size_t size) {
  for (std::size_t i = 0; i < size; i += page_size) {
    volatile auto& byte = memory[i];
    byte = std::byte{1};
  }
}

/// Makes the pages that we shall need present, and keeps what is freed.
void prefault() {
  ::mallopt(M_TRIM_THRESHOLD, -1);
  ::mallopt(M_MMAP_MAX, 0);
  const auto heap = std::make_unique<std::byte[]>(heap_reserve);
  touch_pages(heap, heap_reserve);
  std::array<std::byte, stack_reserve> stack;
  touch_pages(stack, stack_reserve);
}

}  // namespace

void add_realtime_option(CLI::App& command, std::optional<int>& priority) {
  command
      .add_option("--realtime", priority,
                  "Run before all other programs with this priority (SCHED_FIFO), memory locked; needs permission")
      ->check(CLI::Range(1, 99))
      ->type_name("PRIORITY");
}

void enter_realtime(int priority) {
  const sched_param parameters{.sched_priority = priority};
  if (::sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) != 0)
    throw Failure{fmt::format(
        "--realtime {}: the system refuses the priority ({}); give the program CAP_SYS_NICE or its user an rtprio "
        "limit of at least {}, see docs/realtime.md",
        priority, std::strerror(errno), priority)};
  if (::mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
    throw Failure{fmt::format(
        "--realtime {}: the system does not lock the memory ({}); give the program CAP_IPC_LOCK or its user an "
        "unlimited memlock limit (ulimit -l), see docs/realtime.md",
        priority, std::strerror(errno))};
  prefault();
}

}  // namespace ponte::app
