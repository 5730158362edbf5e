#pragma once

#include "ponte/core/id.hpp"

#include <array>
#include <concepts>
#include <cstdint>
#include <numbers>
#include <span>
#include <string_view>

/// What is known of a DLI message before any byte of it arrives. The tables are generated from definitions/dli.
namespace ponte::dli {

using MessageNumber = Id<struct MessageNumberTag, std::uint16_t>;

/// Edition of STANAG 4586: 3 (2012), or A (AEP-84 Volume II Edition A, 2017).
enum class Edition : std::uint8_t { ed3, ed_a };
inline constexpr std::size_t edition_count = 2;

/// How sure we are of an entry: text of the standard or two independent sources; one source; our inference; not known.
enum class Confidence : std::uint8_t { standard, single_source, inferred, unknown };

struct EnumEntry {
  std::uint32_t first;
  std::uint32_t last;  ///< equal to `first` but for ranges such as "32-255 vehicle specific"
  std::string_view label;
};

struct EnumInfo {
  std::string_view key;
  Confidence confidence;
  bool bitmap;
  std::span<const EnumEntry> entries;
};

enum class FieldType : std::uint8_t {
  unsigned_integer,  ///< 1 to 5 bytes
  signed_integer,    ///< two's complement, 1 to 5 bytes
  bam,               ///< binary angular measurement in a signed integer of 1 to 4 bytes
  float32,
  text,           ///< ASCII of fixed width with terminating NUL
  variable_text,  ///< ASCII whose length an earlier field gives
};

/// What an integer means when it is not a physical value.
enum class Role : std::uint8_t { value, enumeration, bitmap, id, table, country };

struct FieldInfo {
  std::uint8_t number;         ///< as in the standard; bit `number - 1` of the presence vector
  std::string_view key;        ///< name in JSON and C++, e.g. "turn_rate"
  std::string_view name;       ///< e.g. "Turn Rate"
  std::string_view unique_id;  ///< e.g. "0101.19"; empty: not known
  FieldType type;
  std::uint8_t width;        ///< bytes on the wire; 0 for variable text
  std::uint8_t length_from;  ///< number of the field that tells the length of a variable text
  Role role;
  double scale;           ///< physical value = raw * scale; 0: no such value, or the scale is not known
  std::string_view unit;  ///< empty: none
  const EnumInfo* enumeration;
  bool since_edition_a;  ///< not in Edition 3
  bool excluded;         ///< out of ponte's scope: skipped when received, never sent
  bool guessed;          ///< type or scale are inferred
};

struct MessageInfo {
  MessageNumber number;
  std::string_view key;
  std::string_view name;                                   ///< in Edition 3, or the only one
  std::string_view name_a;                                 ///< in Edition A
  std::array<std::uint8_t, edition_count> presence_bytes;  ///< width of the presence vector; 0: not known
  std::array<bool, edition_count> in_edition;
  Confidence confidence;
  Confidence confidence_ed3;
  bool partial;                       ///< no field table, or a number in it has a unit and no known scale
  std::span<const FieldInfo> fields;  ///< by number, ascending; empty: only number and name are known

  [[nodiscard]] constexpr std::string_view name_in(Edition edition) const {
    return edition == Edition::ed3 ? name : name_a;
  }
  [[nodiscard]] constexpr std::uint8_t presence_bytes_in(Edition edition) const {
    return presence_bytes[static_cast<std::size_t>(edition)];
  }
  [[nodiscard]] constexpr bool is_in(Edition edition) const { return in_edition[static_cast<std::size_t>(edition)]; }
  /// True when the message can be encoded and decoded in this edition.
  [[nodiscard]] constexpr bool has_fields_in(Edition edition) const {
    return is_in(edition) && presence_bytes_in(edition) != 0 && !fields.empty();
  }
};

/// The messages that a program knows.
struct Catalogue {
  std::span<const MessageInfo* const> messages;  ///< by number, ascending

  /// The message with this number, or nothing.
  [[nodiscard]] constexpr const MessageInfo* find(MessageNumber number) const {
    std::size_t first = 0;
    std::size_t last = messages.size();
    while (first < last) {
      const auto middle = (first + last) / 2;
      if (messages[middle]->number < number)
        first = middle + 1;
      else
        last = middle;
    }
    return first < messages.size() && messages[first]->number == number ? messages[first] : nullptr;
  }
};

/// Stands where a generated struct has no member because the field is out of scope.
struct ExcludedField {};

/// A generated message: one optional per field, and the table that describes them.
template <class M>
concept Message = requires {
  { M::info } -> std::convertible_to<const MessageInfo&>;
};

/// The radians that one unit of a BAM of `width` bytes stands for: pi / 2^(8 width - 1).
[[nodiscard]] constexpr double bam_scale(std::uint8_t width) {
  return std::numbers::pi / static_cast<double>(std::uint64_t{1} << (8U * width - 1U));
}

}  // namespace ponte::dli
