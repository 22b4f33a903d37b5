#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// XML as it is written here: elements with attributes and either a text or elements.
namespace fathom::validation {

struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> elements;
  std::string text;
};

/// A text as it can stand in an attribute or between tags, so that a reader gets it back.
/// Characters that XML 1.0 cannot hold, and what could have effects on a terminal, become '?' or
/// U+FFFD.
/// Source   Extensible Markup Language 1.0, productions 2 (Char), 10 (AttValue), 14 (CharData) and
///          section 3.3.3, by which a line feed in an attribute is read as a space unless it is
///          escaped; fathom/text/printable.h.
std::string xml_text(std::string_view text);

/// An element in a line of its own, those within it below it, indented.
std::string to_xml(const XmlElement& element, int depth = 0);

}  // namespace fathom::validation
