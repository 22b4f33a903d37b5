#include "fathom/text/text_ends.h"

#include "fathom/failures/errors.h"

namespace fathom::text {
namespace {

bool is_ascii(char c) {
  return c > 0 && c < 127;
}

/// Whether every other byte of the first four is zero, and the others are characters of ASCII.
bool has_zeros_between(std::string_view text) {
  if (text.size() < 4) return false;
  const auto is_so = [&](std::size_t character, std::size_t zero) {
    return is_ascii(text[character]) && is_ascii(text[character + 2]) && text[zero] == 0 &&
           text[zero + 2] == 0;
  };
  return is_so(0, 1) || is_so(1, 0);
}

}  // namespace

std::string_view without_padding(std::string_view text) {
  const std::size_t last = text.find_last_not_of(std::string_view("\0\x1A", 2));
  const std::string_view words = text.substr(0, last == text.npos ? 0 : last + 1);
  const bool whole_line = words.empty() || words.ends_with('\n') || words.ends_with('\r');
  return whole_line || text.size() - words.size() == 1 ? words : text;
}

std::string_view without_zeros(std::string_view text) {
  return text.substr(0, text.find_last_not_of('\0') + 1);
}

void expect_no_utf16(std::string_view text, const std::string& file) {
  const bool marked = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  const std::string_view words = marked ? text.substr(2) : text;
  if (has_zeros_between(words) || (marked && words.empty()))
    throw InputError(file + ": is text in UTF-16, expected ASCII or UTF-8");
}

}  // namespace fathom::text
