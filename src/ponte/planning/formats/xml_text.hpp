#pragma once

#include "ponte/planning/formats/mission_file.hpp"

#include <pugixml.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ponte::planning {

/// An XML text that knows the lines of its nodes. These functions throw `FormatError`.
class XmlText {
 public:
  /// Refuses what is no XML, and a DOCTYPE: it could define entities, and no format here has one.
  explicit XmlText(std::string_view text);

  [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }
  [[nodiscard]] const pugi::xml_document& document() const { return document_; }
  /// Where a node begins.
  [[nodiscard]] Where where(const pugi::xml_node& node) const;

 private:
  [[nodiscard]] Where line_at(std::ptrdiff_t offset) const;

  pugi::xml_document document_;
  std::vector<std::ptrdiff_t> line_ends_;
};

/// The name without a namespace prefix.
[[nodiscard]] std::string_view local_name(const pugi::xml_node& node);
/// The first child element of this local name, or an empty node.
[[nodiscard]] pugi::xml_node child(const pugi::xml_node& node, std::string_view name);
/// The text of that child without the white space around it, empty when there is none.
[[nodiscard]] std::string_view child_text(const pugi::xml_node& node, std::string_view name);

/// Adds an element with a text.
void append_text(pugi::xml_node parent, const char* name, const std::string& text);
/// The document as bytes of UTF-8.
[[nodiscard]] std::vector<std::byte> bytes_from(const pugi::xml_document& document);

}  // namespace ponte::planning
