#include "ponte/sim/virtual_files.hpp"

#include "ponte/mavlink/codec.hpp"
#include "ponte/sim/mission_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace ponte::sim {
namespace {

using Item = MissionStore::Item;

constexpr std::string_view parameter_file = "@PARAM/param.pck";
constexpr std::string_view mission_directory = "@MISSION";

// Of a plan: five numbers of 16 bits, then the items as in MISSION_ITEM_INT of MAVLink 2.
constexpr std::uint16_t plan_magic = 0x763D;
constexpr std::size_t plan_header_size = 10;
constexpr std::size_t item_size = Item::info.full_length;
constexpr std::uint16_t keeps_old_items = 1;

// Of parameters: three numbers of 16 bits, then the parameters, each at most so long.
constexpr std::uint16_t parameter_magic = 0x671B;
constexpr std::uint16_t parameter_magic_with_defaults = 0x671C;
constexpr std::size_t parameter_header_size = 6;
constexpr std::size_t packed_parameter_max = 2 + 16 + 2 * 4;

struct PlanFile {
  std::string_view name;
  PlanType type;
};
constexpr std::array plan_files{PlanFile{"mission.dat", PlanType::mission}, PlanFile{"fence.dat", PlanType::fence},
                                PlanFile{"rally.dat", PlanType::rally}};

std::string_view without_root(std::string_view path) {
  while (!path.empty() && path.front() == '/') path.remove_prefix(1);
  while (!path.empty() && path.back() == '/') path.remove_suffix(1);
  return path;
}

std::optional<PlanType> plan_of(std::string_view path) {
  path = without_root(path);
  if (!path.starts_with(mission_directory)) return std::nullopt;
  path = without_root(path.substr(mission_directory.size()));
  for (const auto& each : plan_files)
    if (each.name == path) return each.type;
  return std::nullopt;
}

bool is_parameter_file(std::string_view path) {
  path = without_root(path);
  return path.substr(0, path.find('?')) == parameter_file;
}

template <class Number>
void append(std::vector<std::byte>& content, Number number) {
  std::array<std::byte, sizeof number> bytes{};
  store_le(bytes.data(), number);
  content.insert(content.end(), bytes.begin(), bytes.end());
}

void append(std::vector<std::byte>& content, std::string_view text) {
  const auto bytes = bytes_of(text);
  content.insert(content.end(), bytes.begin(), bytes.end());
}

void append(std::vector<std::byte>& content, const Item& item) {
  const auto at = content.size();
  content.resize(at + item_size);
  Item::visit(item, [to = &content[at]](const mavlink::FieldInfo& field, const auto& value) {
    mavlink::detail::store_field(field, to + field.offset, value);
  });
}

/// The value of `name=` among options that are divided by `&`, or nothing.
std::optional<unsigned> option(std::string_view options, std::string_view name) {
  while (!options.empty()) {
    const auto each = options.substr(0, options.find('&'));
    options.remove_prefix(std::min(options.size(), each.size() + 1));
    if (!each.starts_with(name) || each.size() <= name.size() || each[name.size()] != '=') continue;
    unsigned value{};
    const auto digits = each.substr(name.size() + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc{} && end == digits.data() + digits.size()) return value;
  }
  return std::nullopt;
}

/// 1 to 4, as in the file.
std::uint8_t packed_type(ParameterType type) {
  switch (type) {
    case ParameterType::int8: return 1;
    case ParameterType::int16: return 2;
    case ParameterType::int32: return 3;
    case ParameterType::real32: return 4;
  }
  return 0;
}

void append_value(std::vector<std::byte>& content, ParameterType type, double value) {
  switch (type) {
    case ParameterType::int8: return append(content, static_cast<std::int8_t>(value));
    case ParameterType::int16: return append(content, static_cast<std::int16_t>(value));
    case ParameterType::int32: return append(content, static_cast<std::int32_t>(value));
    case ParameterType::real32: return append(content, static_cast<float>(value));
  }
}

}  // namespace

std::size_t VirtualFiles::largest() const {
  std::size_t items = 0;
  for (const auto& each : plan_files) items = std::max(items, missions_.capacity(each.type));
  return std::max(plan_header_size + items * item_size,
                  parameter_header_size + parameters_.size() * packed_parameter_max);
}

std::size_t VirtualFiles::size_of(PlanType type) const {
  return plan_header_size + missions_.items(type).size() * item_size;
}

bool VirtualFiles::read(std::string_view path, std::vector<std::byte>& content) const {
  content.clear();
  if (const auto type = plan_of(path)) {
    read_plan(*type, content);
    return true;
  }
  if (!is_parameter_file(path)) return false;
  const auto options = path.find('?');
  read_parameters(options == std::string_view::npos ? std::string_view{} : path.substr(options + 1), content);
  return true;
}

void VirtualFiles::read_plan(PlanType type, std::vector<std::byte>& content) const {
  const auto items = missions_.items(type);
  append(content, plan_magic);
  append(content, static_cast<std::uint16_t>(type));
  append(content, std::uint16_t{});  // options
  append(content, std::uint16_t{});  // the first item
  append(content, static_cast<std::uint16_t>(items.size()));
  for (std::size_t i = 0; i < items.size(); ++i) {
    auto item = items[i];
    item.seq = static_cast<std::uint16_t>(i);
    item.mission_type = static_cast<std::uint8_t>(type);
    append(content, item);
  }
}

void VirtualFiles::read_parameters(std::string_view options, std::vector<std::byte>& content) const {
  const bool with_defaults = option(options, "withdefaults").value_or(0) != 0;
  const std::size_t first = std::min<std::size_t>(option(options, "start").value_or(0), parameters_.size());
  const std::size_t wanted = option(options, "count").value_or(0);
  const auto left = parameters_.size() - first;
  const auto count = wanted == 0 ? left : std::min(wanted, left);
  append(content, with_defaults ? parameter_magic_with_defaults : parameter_magic);
  append(content, static_cast<std::uint16_t>(count));
  append(content, static_cast<std::uint16_t>(parameters_.size()));

  std::string_view before;
  for (auto i = first; i < first + count; ++i) {
    const auto& info = parameters_.info(i);
    const auto [differs, unused] = std::mismatch(info.name.begin(), info.name.end() - 1, before.begin(), before.end());
    const auto common = static_cast<std::size_t>(differs - info.name.begin());
    const auto own = info.name.size() - common;
    const bool has_default = with_defaults && parameters_.value(i) != parameters_.default_value(i);
    const unsigned type = packed_type(info.type) | (has_default ? 0x10U : 0U);
    append(content, static_cast<std::uint8_t>(type));
    append(content, static_cast<std::uint8_t>(common | (own - 1) << 4U));
    append(content, info.name.substr(common));
    append_value(content, info.type, parameters_.value(i));
    if (has_default) append_value(content, info.type, parameters_.default_value(i));
    before = info.name;
  }
}

bool VirtualFiles::may_write(std::string_view path) const { return plan_of(path).has_value(); }

bool VirtualFiles::write(std::string_view path, Bytes content) {
  const auto type = plan_of(path);
  if (!type || content.size() < plan_header_size) return false;
  const auto first = std::size_t{u16_le(content, 6)};
  const auto count = std::size_t{u16_le(content, 8)};
  const bool keeps = (u16_le(content, 4) & keeps_old_items) != 0;
  const bool is_such_a_file = u16_le(content, 0) == plan_magic && u16_le(content, 2) == static_cast<unsigned>(*type);
  if (!is_such_a_file || content.size() != plan_header_size + count * item_size) return false;
  if (first + count > missions_.capacity(*type) || first > (keeps ? missions_.items(*type).size() : 0)) return false;

  const auto item_at = [&](std::size_t i) {
    const auto item = mavlink::decode<Item>(content.subspan(plan_header_size + i * item_size, item_size));
    return stored_item(Personality::ardupilot, *type, item);
  };
  for (std::size_t i = 0; i < count; ++i)
    if (!item_at(i)) return false;
  missions_.truncate(*type, keeps ? std::max(first + count, missions_.items(*type).size()) : first + count);
  for (std::size_t i = 0; i < count; ++i) missions_.put(*type, first + i, *item_at(i));
  return true;
}

bool VirtualFiles::directory_exists(std::string_view path) const {
  path = without_root(path);
  return path.empty() || path == mission_directory || path == "@PARAM";
}

bool VirtualFiles::append_entry(std::string_view directory, std::size_t number, std::vector<std::byte>& listing) const {
  directory = without_root(directory);
  if (directory.empty()) {
    constexpr std::array<std::string_view, 2> entries{"D@MISSION", "D@PARAM"};
    if (number >= entries.size()) return false;
    append(listing, entries[number]);
    return true;
  }
  if (directory != mission_directory || number >= plan_files.size()) return false;
  std::array<char, 64> text{};
  const auto& file = plan_files[number];
  const auto size = fmt::format_to_n(text.data(), text.size(), "F{}\t{}", file.name, size_of(file.type)).size;
  append(listing, std::string_view{text.data(), size});
  return true;
}

}  // namespace ponte::sim
