#pragma once

#include <tl/expected.hpp>

#include <utility>

namespace ponte {

/// A value, or the reason why there is none. A refusal that we expect is a value, never an exception.
template <class T, class E>
using Result = tl::expected<T, E>;

template <class E>
[[nodiscard]] constexpr auto fail(E&& error) {
  return tl::make_unexpected(std::forward<E>(error));
}

}  // namespace ponte
