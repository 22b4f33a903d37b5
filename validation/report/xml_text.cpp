#include "validation/report/xml_text.h"

#include "fathom/text/printable.h"

namespace fathom::validation {

std::string xml_text(std::string_view text) {
  std::string result = text::printable_lines(text);
  for (const char* no_character : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {
    for (std::size_t at = 0; (at = result.find(no_character, at)) != std::string::npos; at += 3) {
      result.replace(at, 3, "\xEF\xBF\xBD");
    }
  }
  return result;
}

}  // namespace fathom::validation
