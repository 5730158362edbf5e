#pragma once

#include "ponte/dli/message_info.hpp"

#include <array>
#include <cstddef>
#include <type_traits>

namespace ponte::vsm {

/// Makes those fields of `message` absent that `told` has with the same value, and notes the others in `told`; the time
/// stamp stays in any case. Returns whether another field is left.
template <dli::Message M>
bool keep_changes(M& message, M& told) {
  std::array<void*, M::fields.size()> members{};
  std::size_t index = 0;
  M::visit(told, [&]<class T>(const dli::FieldInfo&, T&& member) {
    if constexpr (!std::is_same_v<std::remove_cvref_t<T>, dli::ExcludedField>) members[index] = &member;
    ++index;
  });
  bool any = false;
  index = 0;
  M::visit(message, [&]<class T>(const dli::FieldInfo& field, T&& member) {
    auto* const before = members[index++];
    if constexpr (!std::is_same_v<std::remove_cvref_t<T>, dli::ExcludedField>) {
      constexpr std::uint8_t time_stamp = 1;
      auto& last = *static_cast<std::remove_cvref_t<T>*>(before);
      if (!member || field.number == time_stamp) return;
      if (last == member) {
        member.reset();
      } else {
        last = member;
        any = true;
      }
    }
  });
  return any;
}

}  // namespace ponte::vsm
