#pragma once

#include <cstdio>
#include <cstdlib>

/// Ends the program when `condition`, which only a mistake of ours can break, does not hold. It stays on in release
/// builds; input is never asserted.
#define PONTE_ASSERT(condition)                                                               \
  do {                                                                                        \
    if (!(condition)) [[unlikely]] {                                                          \
      std::fprintf(stderr, "%s:%d: broken assumption: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                           \
    }                                                                                         \
  } while (false)
