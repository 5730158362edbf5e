#pragma once

#include "ponte/core/id.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

/// What is known of a MAVLink message before any byte of it arrives. The tables are generated from the XML definitions.
namespace ponte::mavlink {

using SystemId = Id<struct SystemIdTag, std::uint8_t>;
using ComponentId = Id<struct ComponentIdTag, std::uint8_t>;
using MessageId = Id<struct MessageIdTag, std::uint32_t>;  ///< 24 bits in MAVLink 2, 8 in MAVLink 1

enum class FieldType : std::uint8_t {
  character,
  uint8,
  int8,
  uint16,
  int16,
  uint32,
  int32,
  uint64,
  int64,
  float32,
  float64,
};

/// Bytes of one element on the wire.
[[nodiscard]] constexpr std::uint8_t size_of(FieldType type) {
  switch (type) {
    case FieldType::character:
    case FieldType::uint8:
    case FieldType::int8: return 1;
    case FieldType::uint16:
    case FieldType::int16: return 2;
    case FieldType::uint32:
    case FieldType::int32:
    case FieldType::float32: return 4;
    case FieldType::uint64:
    case FieldType::int64:
    case FieldType::float64: return 8;
  }
  return 0;
}

struct EnumEntry {
  std::uint64_t value;
  std::string_view name;
};

struct EnumInfo {
  std::string_view name;
  bool bitmask;
  std::span<const EnumEntry> entries;  ///< by value, ascending
};

struct FieldInfo {
  std::string_view name;
  FieldType type;
  std::uint8_t array_length;  ///< 0: not an array
  std::uint8_t offset;        ///< in the payload of full length
  bool extension;             ///< MAVLink 2 only, and not part of crc_extra
  std::string_view unit;      ///< as the definition writes it, e.g. "degE7"; empty: none
  std::string_view invalid;   ///< the value that means "unknown", as the definition writes it; empty: none
  const EnumInfo* enumeration;
  bool instance{};    ///< tells several of the message apart, e.g. the number of a battery
  bool big_endian{};  ///< in MAVLink 0.9, where all fields are; since then none is

  [[nodiscard]] constexpr std::size_t size() const {
    return std::size_t{size_of(type)} * (array_length == 0 ? 1U : array_length);
  }
};

struct MessageInfo {
  MessageId id;
  std::string_view name;
  std::uint8_t crc_extra;             ///< checksum seed made of names, types and order of the fields
  std::uint8_t base_length;           ///< payload bytes without extensions: the whole of a MAVLink 1 payload
  std::uint8_t full_length;           ///< payload bytes with extensions, before MAVLink 2 drops trailing zeros
  std::span<const FieldInfo> fields;  ///< in the order of the definition

  /// The field with this name, or nothing.
  [[nodiscard]] constexpr const FieldInfo* find(std::string_view wanted) const {
    for (const auto& field : fields)
      if (field.name == wanted) return &field;
    return nullptr;
  }

  /// True for a message of MAVLink 0.9, false for one of MAVLink 1 and 2.
  [[nodiscard]] constexpr bool is_v09() const { return !fields.empty() && fields.front().big_endian; }
};

/// A generated message: a plain struct with its table, whose fields can be visited with their descriptions.
template <class M>
concept Message = requires(M message) {
  { M::info } -> std::convertible_to<const MessageInfo&>;
};

/// A set of messages that a program speaks.
struct Dialect {
  std::string_view name;
  std::span<const MessageInfo* const> messages;  ///< by id, ascending
  /// What is spoken in MAVLink 0.9, by id and then length; nothing: its messages are unknown.
  const Dialect* v09{};
  /// The messages with the ids 0, 1, 2 ..., nothing where there is none; may be shorter than needed, or empty.
  std::span<const MessageInfo* const> low{};

  /// True if `messages` are those of MAVLink 0.9: such a dialect is the `v09` of another.
  [[nodiscard]] constexpr bool is_v09() const { return !messages.empty() && messages.front()->is_v09(); }

  /// The message of MAVLink 0.9 with this id and payload length, or nothing. Only the length tells messages of
  /// different dialects apart there.
  [[nodiscard]] constexpr const MessageInfo* find_v09(MessageId id, std::size_t length) const {
    if (v09 == nullptr) return nullptr;
    const auto* const end = v09->messages.data() + v09->messages.size();
    for (const auto* at = v09->first_from(id); at != end && (*at)->id == id; ++at)
      if ((*at)->full_length == length) return *at;
    return nullptr;
  }

  /// The message of MAVLink 1 and 2 with this id, or nothing.
  [[nodiscard]] constexpr const MessageInfo* find(MessageId id) const {
    if (id.value < low.size()) return low[id.value];
    const auto* const at = first_from(id);
    return at != messages.data() + messages.size() && (*at)->id == id ? *at : nullptr;
  }
  /// The message with this name, e.g. "HEARTBEAT", or nothing. Looks at one after the other.
  [[nodiscard]] constexpr const MessageInfo* find(std::string_view wanted) const {
    for (const auto* message : messages)
      if (message->name == wanted) return message;
    return nullptr;
  }

 private:
  /// The first message whose id is not below this one.
  [[nodiscard]] constexpr const MessageInfo* const* first_from(MessageId id) const {
    return std::lower_bound(messages.data(), messages.data() + messages.size(), id,
                            [](const MessageInfo* message, MessageId wanted) { return message->id < wanted; });
  }
};

/// For `Dialect::low`: nearly all messages that are sent have such ids.
[[nodiscard]] constexpr auto low_messages(std::span<const MessageInfo* const> messages) {
  std::array<const MessageInfo*, 512> low{};
  for (const auto* message : messages)
    if (message->id.value < low.size()) low[message->id.value] = message;
  return low;
}

}  // namespace ponte::mavlink
