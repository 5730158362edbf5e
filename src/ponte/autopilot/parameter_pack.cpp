#include "ponte/autopilot/parameter_pack.hpp"

#include <algorithm>
#include <optional>

namespace ponte::autopilot {
namespace {

constexpr std::uint16_t magic = 0x671B;
constexpr std::uint16_t magic_with_defaults = 0x671C;
constexpr std::size_t header_size = 6;
constexpr unsigned has_default = 0x10;

struct PackedType {
  ParameterType type;
  std::size_t size;
};

/// Of the number in the file; 0 is no parameter, but a byte that fills up a block.
std::optional<PackedType> packed_type(unsigned number) {
  switch (number) {
    case 1: return PackedType{ParameterType::int8, 1};
    case 2: return PackedType{ParameterType::int16, 2};
    case 3: return PackedType{ParameterType::int32, 4};
    case 4: return PackedType{ParameterType::real32, 4};
    default: return std::nullopt;
  }
}

double value_at(const std::byte* at, ParameterType type) {
  switch (type) {
    case ParameterType::int8: return load_le<std::int8_t>(at);
    case ParameterType::int16: return load_le<std::int16_t>(at);
    case ParameterType::int32: return load_le<std::int32_t>(at);
    default: return double{load_le<float>(at)};
  }
}

}  // namespace

Result<std::vector<Parameter>, PackError> unpack_parameters(Bytes file) {
  const auto refuse = [&](std::size_t offset, std::string_view what) { return fail(PackError{offset, what}); };
  if (file.size() < header_size) return refuse(file.size(), "the header is cut off");
  const auto kind = u16_le(file, 0);
  if (kind != magic && kind != magic_with_defaults) return refuse(0, "it does not begin with the magic number");

  std::vector<Parameter> result;
  const std::size_t count = u16_le(file, 2);
  ParameterName before;
  for (std::size_t at = header_size; result.size() < count;) {
    if (at == file.size()) return refuse(at, "there are fewer parameters than the header says");
    const unsigned flags = u8(file, at);
    if (flags == 0) {
      ++at;
      continue;
    }
    const auto type = packed_type(flags & 0x0FU);
    if (!type) return refuse(at, "the type is unknown");
    if (at + 2 > file.size()) return refuse(file.size(), "a parameter is cut off");
    const unsigned lengths = u8(file, at + 1);
    const std::size_t common = lengths & 0x0FU;
    const std::size_t own = (lengths >> 4U) + 1;
    const std::size_t values = (flags & has_default) != 0 ? 2 : 1;
    const auto end = at + 2 + own + values * type->size;
    if (common > before.view().size() || common + own > ParameterName::capacity)
      return refuse(at + 1, "the lengths of the name do not fit");
    if (end > file.size()) return refuse(file.size(), "a parameter is cut off");
    ParameterName name{before.view().substr(0, common)};
    const auto rest = file.subspan(at + 2, own);
    std::ranges::transform(rest, name.chars().begin() + static_cast<std::ptrdiff_t>(common),
                           [](std::byte byte) { return static_cast<char>(byte); });
    if (name.view().size() != common + own) return refuse(at + 2, "the name has a NUL");
    result.push_back({.name = name, .type = type->type, .value = value_at(&file[at + 2 + own], type->type)});
    before = name;
    at = end;
  }
  return result;
}

}  // namespace ponte::autopilot
