#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// The one model between readers and emitters: what a protocol's messages are made of, whichever file said so.
namespace ponte::definitions {

/// Where a definition stands, for error messages.
struct Source {
  std::filesystem::path file;
  std::size_t line{};
};

/// A definition that cannot be used. `what()` reads "file:line: what was wrong and what was expected".
class DefinitionError : public std::runtime_error {
 public:
  DefinitionError(const Source& source, std::string_view what);
};

enum class Kind : std::uint8_t { unsigned_integer, signed_integer, real, character, bam };

struct Entry {
  std::uint64_t first{};
  std::uint64_t last{};
  std::string name{};  ///< MAV_STATE_ACTIVE in MAVLink, "Waypoint" in the DLI
  std::string note;
  Source source;
};

struct Enumeration {
  std::string name;
  bool bitmap{};
  std::string confidence;  ///< DLI only
  std::vector<Entry> entries;
  Source source;
};

struct Field {
  std::string name;
  std::string key;  ///< the C++ and JSON name
  Kind kind{};
  std::size_t width{};  ///< bytes of one element on the wire; 0: variable text
  std::size_t count{};  ///< 0: one element, not an array
  std::string unit;
  std::string enumeration;  ///< name; empty: none
  std::string note;
  Source source;

  // MAVLink
  bool extension{};
  bool instance{};  ///< tells several of the message apart
  std::string invalid;
  std::string initial;  ///< value a sender starts from; empty: zero
  std::size_t offset{};

  // DLI
  std::size_t number{};
  std::string unique_id;
  std::string role;  ///< enum, bitmap, id, table, country; empty: a value
  double scale{};    ///< 0: none, or not known
  std::size_t length_from{};
  bool since_edition_a{};
  bool excluded{};
  bool guessed{};

  [[nodiscard]] std::size_t size() const { return width * (count == 0 ? 1 : count); }
  [[nodiscard]] bool is_integer() const { return kind == Kind::unsigned_integer || kind == Kind::signed_integer; }
  /// DLI: true for a physical value that cannot be computed from its raw integer.
  [[nodiscard]] bool lacks_scale() const {
    return is_integer() && !excluded && role.empty() && !unit.empty() && scale == 0;
  }
};

inline constexpr std::size_t edition_count = 2;  ///< Edition 3, Edition A

struct Message {
  std::uint32_t number{};
  std::string name;
  std::string key;   ///< file name and, in PascalCase, the C++ name
  std::string note;  ///< description
  std::vector<Field> fields;
  Source source;

  // MAVLink, computed from the fields
  std::uint8_t crc_extra{};
  std::size_t base_length{};
  std::size_t full_length{};

  // DLI
  std::string name_a;
  std::array<bool, edition_count> in_edition{};
  std::array<std::size_t, edition_count> presence_bytes{};
  std::string direction;
  std::string exchange;
  std::string confidence;
  std::string confidence_ed3;
  std::vector<std::string> sources;
  std::uint32_t number_ed2{};        ///< 0: none
  std::uint32_t latency_ms{};        ///< largest transport delay that Edition 2 allows; 0: not known
  std::vector<std::int64_t> levels;  ///< of interoperability
  bool partial{};
};

/// A functional group of the DLI: documentation, not needed to encode or decode.
struct Group {
  std::string name;
  std::uint32_t first{};
  std::uint32_t last{};
  std::uint32_t message_count{};  ///< in Edition 3
  std::string table;              ///< of Edition 3
};

struct Protocol {
  std::string name;
  std::vector<Message> messages;          ///< by number, ascending; in MAVLink 0.9 then by length
  std::vector<Enumeration> enumerations;  ///< by name, ascending
  std::vector<Group> groups{};
  bool v09{};  ///< MAVLink 0.9: big-endian fields in the order of the definition, and no checksum seed

  [[nodiscard]] const Enumeration* find_enumeration(std::string_view wanted) const;
};

/// Throws `DefinitionError` when the file cannot be read.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

}  // namespace ponte::definitions
