#include "ponte/dli/profile_file.hpp"

#include "ponte/dli/integers.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace ponte::dli {
namespace {

/// Reads one profile. What is wrong leaves as an exception, which ends in `parse_profile`.
class ProfileFileReader {
 public:
  explicit ProfileFileReader(const Catalogue& catalogue) : catalogue_{&catalogue} {}

  [[nodiscard]] Profile read(const toml::table& root) {
    refuse_other_keys(root, "", {"edition", "idd_version", "checksum", "accept_unassigned_checksum", "override"});
    if (const auto* node = root.get("edition")) profile_ = Profile{edition_in(*node)};
    if (const auto* node = root.get("idd_version"))
      profile_.idd_version = static_cast<std::uint8_t>(integer_in(*node, "idd_version", 0, 127));
    if (const auto* node = root.get("checksum")) profile_.checksum = checksum_in(*node);
    if (const auto* node = root.get("accept_unassigned_checksum")) {
      if (!node->is_boolean()) refuse(*node, "accept_unassigned_checksum", "true or false");
      profile_.accept_unassigned_checksum = node->as_boolean()->get();
    }
    if (const auto* node = root.get("override")) read_overrides(*node);
    return profile_;
  }

 private:
  [[noreturn]] static void refuse(const toml::node& node, std::string key, std::string expectation) {
    throw ProfileFileError{node.source().begin.line, std::move(key), std::move(expectation)};
  }

  static void refuse_other_keys(const toml::table& table, std::string_view prefix,
                                std::initializer_list<std::string_view> known) {
    for (const auto& [key, node] : table) {
      if (std::ranges::find(known, key.str()) != known.end()) continue;
      std::string keys;
      for (const auto name : known) keys.append(keys.empty() ? "one of " : ", ").append(name);
      throw ProfileFileError{key.source().begin.line, std::string{prefix}.append(key.str()), keys};
    }
  }

  static std::int64_t integer_in(const toml::node& node, const std::string& key, std::int64_t first,
                                 std::int64_t last) {
    const auto* integer = node.as_integer();
    if (integer == nullptr || integer->get() < first || integer->get() > last)
      refuse(node, key, "an integer from " + std::to_string(first) + " to " + std::to_string(last));
    return integer->get();
  }

  static Edition edition_in(const toml::node& node) {
    const auto text = node.value_exact<std::string_view>();
    if (text == name_of(Edition::ed3)) return Edition::ed3;
    if (text == name_of(Edition::ed_a)) return Edition::ed_a;
    refuse(node, "edition", "\"3\" or \"A\"");
  }

  static Checksum checksum_in(const toml::node& node) {
    const auto* bytes = node.as_integer();
    for (const auto checksum : {Checksum::none, Checksum::sum16, Checksum::sum32})
      if (bytes != nullptr && bytes->get() == static_cast<std::int64_t>(size_of(checksum))) return checksum;
    refuse(node, "checksum", "0, 2 or 4");
  }

  void read_overrides(const toml::node& node) {
    const auto* overrides = node.as_array();
    if (overrides == nullptr || !overrides->is_array_of_tables())
      refuse(node, "override", "tables that begin with [[override]]");
    for (const auto& entry : *overrides) read_override(*entry.as_table());
  }

  void read_override(const toml::table& entry) {
    refuse_other_keys(entry, "override.", {"message", "field", "scale", "presence_bytes"});
    const auto& message = message_in(entry);
    const auto* field = entry.get("field");
    const auto* scale = entry.get("scale");
    const auto* presence_bytes = entry.get("presence_bytes");
    if ((field == nullptr) != (scale == nullptr)) refuse(entry, "override", "field and scale together");
    if (field == nullptr && presence_bytes == nullptr) refuse(entry, "override", "field and scale, or presence_bytes");
    if (field != nullptr) {
      const auto& scaled = field_in(message, *field);
      profile_.override_scale(message.number, scaled.number, scale_in(*scale));
    }
    if (presence_bytes != nullptr) {
      const auto bytes = integer_in(*presence_bytes, "override.presence_bytes", 1, 8);
      profile_.override_presence_bytes(message.number, static_cast<std::uint8_t>(bytes));
    }
  }

  [[nodiscard]] const MessageInfo& message_in(const toml::table& entry) const {
    const auto* node = entry.get("message");
    if (node == nullptr) refuse(entry, "override.message", "the number of a message");
    const auto number = static_cast<std::uint16_t>(integer_in(*node, "override.message", 1, 65535));
    const auto* message = catalogue_->find(MessageNumber{number});
    if (message == nullptr || message->fields.empty())
      refuse(*node, "override.message", "the number of a message whose fields are known");
    return *message;
  }

  static const FieldInfo& field_in(const MessageInfo& message, const toml::node& node) {
    const auto key = node.value_exact<std::string_view>();
    const auto number = node.value_exact<std::int64_t>();
    const auto field = std::ranges::find_if(
        message.fields, [&](const FieldInfo& known) { return key == known.key || number == known.number; });
    const auto has_scale =
        field != message.fields.end() && !field->excluded && field->type != FieldType::bam && is_integer(field->type);
    if (!has_scale)
      refuse(node, "override.field",
             "the key or the number of a scaled integer field of message " + std::to_string(message.number.value));
    return *field;
  }

  static double scale_in(const toml::node& node) {
    const auto scale = node.value<double>();
    if (!node.is_number() || !scale || !std::isfinite(*scale) || *scale <= 0)
      refuse(node, "override.scale", "a number above 0");
    return *scale;
  }

  const Catalogue* catalogue_;
  Profile profile_;
};

/// The TOML reader calls itself for every dot of a key, so a line without end would take the stack with it.
void refuse_endless_lines(std::string_view text) {
  constexpr std::size_t longest_line = 4000;
  for (std::uint32_t line = 1; !text.empty(); ++line) {
    const auto end = std::min(text.find('\n'), text.size());
    if (end > longest_line) throw ProfileFileError{line, "", "lines of at most 4000 characters"};
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace

Result<Profile, ProfileFileError> parse_profile(std::string_view text, const Catalogue& catalogue) try {
  refuse_endless_lines(text);
  return ProfileFileReader{catalogue}.read(toml::parse(text));
} catch (const toml::parse_error& error) {
  return fail(ProfileFileError{error.source().begin.line, "", "TOML, but: " + std::string{error.description()}});
} catch (const ProfileFileError& error) {
  return fail(error);
}

}  // namespace ponte::dli
