#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

/// Of the sanitizers' run time; null in a build without one.
extern "C" [[gnu::weak]] int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*,
                                                                                         std::size_t),
                                                                       void (*on_free)(const volatile void*));

namespace ponte {

inline std::atomic<std::uint64_t> allocation_count;

/// Has every allocation of memory counted from now on, by `new` or `malloc`, in libraries too. False in a build without
/// a sanitizer, whose allocator it is that counts.
inline bool count_allocations() {
  static const bool is_counting =
      __sanitizer_install_malloc_and_free_hooks != nullptr &&
      __sanitizer_install_malloc_and_free_hooks([](const volatile void*, std::size_t) { ++allocation_count; },
                                                [](const volatile void*) {}) != 0;
  return is_counting;
}

}  // namespace ponte
