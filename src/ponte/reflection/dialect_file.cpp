#include "ponte/reflection/dialect_file.hpp"

#include "ponte/definitions/mavlink_reader.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ponte::reflection {
namespace {

using mavlink::FieldType;
using mavlink::MessageInfo;

FieldType unsigned_type(std::size_t width) {
  return width == 1   ? FieldType::uint8
         : width == 2 ? FieldType::uint16
         : width == 4 ? FieldType::uint32
                      : FieldType::uint64;
}

FieldType signed_type(std::size_t width) {
  return width == 1   ? FieldType::int8
         : width == 2 ? FieldType::int16
         : width == 4 ? FieldType::int32
                      : FieldType::int64;
}

FieldType type_of(const definitions::Field& field) {
  switch (field.kind) {
    case definitions::Kind::character: return FieldType::character;
    case definitions::Kind::real: return field.width == 4 ? FieldType::float32 : FieldType::float64;
    case definitions::Kind::signed_integer: return signed_type(field.width);
    default: return unsigned_type(field.width);
  }
}

}  // namespace

/// The names stay in the model; each vector is filled once, so that what points into it stays right.
struct DialectFile::Tables {
  explicit Tables(definitions::Protocol protocol) : model{std::move(protocol)} {
    entries.reserve(model.enumerations.size());
    enums.reserve(model.enumerations.size());
    for (const auto& enumeration : model.enumerations) add(enumeration);
    fields.reserve(model.messages.size());
    messages.reserve(model.messages.size());
    for (const auto& message : model.messages) add(message);
    for (const auto& message : messages) by_id.push_back(&message);
    dialect = {model.name, by_id};
  }

  void add(const definitions::Enumeration& enumeration) {
    auto& list = entries.emplace_back();
    for (const auto& entry : enumeration.entries) list.push_back({entry.first, entry.name});
    enums.push_back({enumeration.name, enumeration.bitmap, list});
  }

  void add(const definitions::Message& message) {
    auto& list = fields.emplace_back();
    for (const auto& field : message.fields)
      list.push_back({.name = field.name,
                      .type = type_of(field),
                      .array_length = static_cast<std::uint8_t>(field.count),
                      .offset = static_cast<std::uint8_t>(field.offset),
                      .extension = field.extension,
                      .unit = field.unit,
                      .invalid = field.invalid,
                      .enumeration = find(field.enumeration),
                      .instance = field.instance,
                      .big_endian = model.v09});
    messages.push_back({.id = mavlink::MessageId{message.number},
                        .name = message.name,
                        .crc_extra = message.crc_extra,
                        .base_length = static_cast<std::uint8_t>(message.base_length),
                        .full_length = static_cast<std::uint8_t>(message.full_length),
                        .fields = list});
  }

  [[nodiscard]] const mavlink::EnumInfo* find(std::string_view name) const {
    const auto found = std::ranges::lower_bound(enums, name, {}, &mavlink::EnumInfo::name);
    return found != enums.end() && found->name == name ? &*found : nullptr;
  }

  definitions::Protocol model;
  std::vector<std::vector<mavlink::EnumEntry>> entries;
  std::vector<mavlink::EnumInfo> enums;
  std::vector<std::vector<mavlink::FieldInfo>> fields;
  std::vector<MessageInfo> messages;
  std::vector<const MessageInfo*> by_id;
  mavlink::Dialect dialect;
};

DialectFile::DialectFile(std::unique_ptr<const Tables> tables) : tables_{std::move(tables)} {}
DialectFile::DialectFile(DialectFile&&) noexcept = default;
DialectFile& DialectFile::operator=(DialectFile&&) noexcept = default;
DialectFile::~DialectFile() = default;

const mavlink::Dialect& DialectFile::dialect() const { return tables_->dialect; }

DialectFile load_dialect(const std::filesystem::path& file, const std::vector<std::filesystem::path>& search_path) {
  return DialectFile{std::make_unique<const DialectFile::Tables>(definitions::read_mavlink(file, search_path))};
}

DialectFile parse_dialect(std::string_view text, const std::filesystem::path& name) {
  return DialectFile{std::make_unique<const DialectFile::Tables>(definitions::read_mavlink_text(text, name))};
}

std::vector<const MessageInfo*> messages_of(const mavlink::Dialect& first, const mavlink::Dialect& second) {
  const auto key = [](const MessageInfo* message) {
    return std::pair{message->id, message->is_v09() ? message->full_length : 0};
  };
  std::vector<const MessageInfo*> both;
  std::ranges::set_union(first.messages, second.messages, std::back_inserter(both), {}, key, key);
  return both;
}

}  // namespace ponte::reflection
