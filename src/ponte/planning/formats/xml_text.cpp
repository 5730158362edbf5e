#include "ponte/planning/formats/xml_text.hpp"

#include "ponte/planning/formats/refusal.hpp"
#include "ponte/planning/formats/text.hpp"

#include <algorithm>
#include <sstream>

namespace ponte::planning {

XmlText::XmlText(std::string_view text) {
  for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1))
    line_ends_.push_back(static_cast<std::ptrdiff_t>(at));
  const auto parsed =
      document_.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_doctype, pugi::encoding_utf8);
  if (!parsed) refuse(line_at(parsed.offset), parsed.description(), "XML");
  for (const auto& node : document_.children())
    if (node.type() == pugi::node_doctype) refuse(where(node), "it has a DOCTYPE", "none");
}

Where XmlText::where(const pugi::xml_node& node) const { return line_at(node.offset_debug()); }

Where XmlText::line_at(std::ptrdiff_t offset) const {
  return at_line(1 + static_cast<std::size_t>(std::ranges::lower_bound(line_ends_, offset) - line_ends_.begin()));
}

std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name{node.name()};
  return name.substr(name.find(':') + 1);
}

pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
  return node.find_child([&](const pugi::xml_node& each) { return local_name(each) == name; });
}

std::string_view child_text(const pugi::xml_node& node, std::string_view name) {
  return trimmed(child(node, name).child_value());
}

void append_text(pugi::xml_node parent, const char* name, const std::string& text) {
  parent.append_child(name).append_child(pugi::node_pcdata).set_value(text.c_str());
}

std::vector<std::byte> bytes_from(const pugi::xml_document& document) {
  std::ostringstream text;
  document.save(text, " ", pugi::format_indent, pugi::encoding_utf8);
  return bytes_from(text.str());
}

}  // namespace ponte::planning
