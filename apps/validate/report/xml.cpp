#include "apps/validate/report/xml.h"

#include "fathom/text/printable.h"

namespace fathom::validation {
namespace {

/// U+FFFE and U+FFFF are UTF-8 and no characters.
void replace_noncharacters(std::string& text) {
  for (const char* no_character : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {
    for (std::size_t at = 0; (at = text.find(no_character, at)) != std::string::npos; at += 3) {
      text.replace(at, 3, "\xEF\xBF\xBD");
    }
  }
}

std::string escaped(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\t':
      return "&#9;";
    case '\n':
      return "&#10;";
    default:
      return {c};
  }
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string possible = text::printable_lines(text), result;
  replace_noncharacters(possible);
  for (const char c : possible) result += escaped(c);
  return result;
}

std::string to_xml(const XmlElement& element, int depth) {
  const std::string indent(2 * static_cast<std::size_t>(depth), ' ');
  std::string xml = indent + "<" + element.name;
  for (const auto& [name, value] : element.attributes) {
    xml += " " + name + "=\"" + xml_text(value) + "\"";
  }
  if (element.elements.empty() && element.text.empty()) return xml + "/>\n";
  xml += ">" + xml_text(element.text);
  if (!element.elements.empty()) {
    xml += "\n";
    for (const XmlElement& inner : element.elements) xml += to_xml(inner, depth + 1);
    xml += indent;
  }
  return xml + "</" + element.name + ">\n";
}

}  // namespace fathom::validation
