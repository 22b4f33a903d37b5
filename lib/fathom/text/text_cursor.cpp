#include "fathom/text/text_cursor.h"

#include <charconv>
#include <system_error>

#include "fathom/numeric/errors.h"
#include "fathom/text/printable.h"

namespace fathom::text {

const char* TextCursor::parse_integer(const char* first, const char* last, std::int64_t& value) {
  if (first != last && *first == '+') {
    ++first;
    if (first != last && *first == '-') return nullptr;
  }
  const auto [end, error] = std::from_chars(first, last, value);
  return error == std::errc() ? end : nullptr;
}

bool TextCursor::joins(const char* first, const char* line_end) {
  const char* last = line_end;
  if (last != first && last[-1] == '\r') --last;
  if (last == first || last[-1] != '\\') return false;
  // A comment begins a word; what follows it is not part of the line.
  for (const char* at = first; at != last; ++at)
    if (*at == '#' && (at == first || is_blank(at[-1]))) return false;
  return true;
}

bool TextCursor::skip_line_join() {
  const char* next = at_ + 1;
  if (next != end_ && *next == '\r' && line_end_ == '\n') ++next;
  if (next == end_ || *next != line_end_) {
    // A '\' at the very end of the file joins nothing; any other is part of a word.
    if (next == end_) at_ = end_;
    return next == end_;
  }
  at_ = next + 1;
  ++line_;
  return true;
}

void TextCursor::skip_rest_of_comment() {
  // at_line_end() has consumed line joins before this is called: what is left has none.
  const void* found = std::memchr(at_, line_end_, static_cast<std::size_t>(end_ - at_));
  at_ = found ? static_cast<const char*>(found) + 1 : end_;
  if (found) ++line_;
}

void TextCursor::fail_at(std::uint64_t line, const std::string& message) const {
  throw InputError(*file_ + ": line " + std::to_string(line) + ": " + message);
}

void TextCursor::fail_here(const std::string& message) {
  constexpr std::size_t longest = 40;
  const std::string shown = printable(std::string(word().substr(0, longest)));
  if (shown.empty()) fail(message + ", found the end of the line");
  fail(message + ", found '" + shown + "'");
}

void TextCursor::fail_missing(const char* what) const {
  fail(std::string("expected ") + what + ", found the end of the line");
}

void TextCursor::fail_number(const char* what, DecimalFault fault) {
  switch (fault) {
    case DecimalFault::overflow:
      fail_here(std::string(what) + " is too large, expected a finite number");
    case DecimalFault::not_finite:
      fail_here(std::string(what) + " is not finite, expected a finite number");
    default:
      fail_here(std::string("expected ") + what);
  }
}

void TextCursor::fail_integer(const char* what) {
  fail_here(std::string("expected ") + what);
}

}  // namespace fathom::text
