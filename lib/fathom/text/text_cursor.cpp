#include "fathom/text/text_cursor.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <system_error>

#include "fathom/failures/errors.h"
#include "fathom/text/printable.h"

namespace fathom::text {
namespace {

std::string in_capitals(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

/// "1.#INF", "-1.#IND00": older versions of the C library of Windows wrote such words for numbers
/// that are not finite.
template <class Real>
DecimalResult<Real> windows_number(std::string_view word) {
  constexpr DecimalResult<Real> malformed{0, nullptr, DecimalFault::malformed};
  const bool negative = word.starts_with('-');
  if (negative) word.remove_prefix(1);
  if (!word.starts_with("1.#")) return malformed;
  const std::string name = in_capitals(word.substr(3, word.find_last_not_of('0') - 2));
  using Limits = std::numeric_limits<Real>;
  Real value = Limits::quiet_NaN();
  if (name == "INF") {
    value = negative ? -Limits::infinity() : Limits::infinity();
  } else if (name != "IND" && name != "QNAN" && name != "SNAN") {
    return malformed;
  }
  return {value, nullptr, DecimalFault::not_finite};
}

}  // namespace

std::string_view TextCursor::rest_of_line() const {
  const char* line = at_;
  while (true) {
    const auto left = static_cast<std::size_t>(end_ - line);
    const void* found = left > 0 ? std::memchr(line, line_end_, left) : nullptr;
    const char* line_end = found ? static_cast<const char*>(found) : end_;
    if (!found || !syntax_.continuation || !joins(line, line_end))
      return {at_, static_cast<std::size_t>(line_end - at_)};
    line = line_end + 1;
  }
}

template <class Real>
DecimalResult<Real> TextCursor::reread() const {
  const char* end = at_;
  while (!at_word_end(end)) ++end;
  const std::string_view word(at_, static_cast<std::size_t>(end - at_));
  DecimalResult<Real> result = parse_decimal<Real>(at_, end);
  if (result.end == end) return result;
  result = windows_number<Real>(word);
  const std::size_t letter = word.find_first_of("dD");
  if (result.fault == DecimalFault::malformed && letter != word.npos) {
    std::string usual(word);
    usual[letter] = 'e';
    result = parse_decimal<Real>(usual.data(), usual.data() + usual.size());
    if (result.end != usual.data() + usual.size()) result = {0, nullptr, DecimalFault::malformed};
  }
  result.end = end;
  return result;
}

template DecimalResult<float> TextCursor::reread<float>() const;
template DecimalResult<double> TextCursor::reread<double>() const;

const char* TextCursor::parse_any_integer(const char* first, const char* last,
                                          std::int64_t& value) {
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
  // Callers call at_line_end() first, which consumes line joins: no line join is left here.
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
