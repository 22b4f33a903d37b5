#pragma once

#include <string>
#include <string_view>

namespace fathom::validation {

/// A text that XML 1.0 can hold: control characters but tab and line feed become '?', what is not
/// UTF-8 and the two codes that are no characters, U+FFFE and U+FFFF, become U+FFFD. Nothing is
/// escaped: pugixml does that as it writes.
/// Source   Extensible Markup Language 1.0, production 2 (Char); fathom/text/printable.h for what
///          else is replaced.
std::string xml_text(std::string_view text);

}  // namespace fathom::validation
