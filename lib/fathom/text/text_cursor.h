#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "fathom/text/decimal.h"

namespace fathom::text {

/// Walks over text, line by line and word by word, and counts lines.
///
/// Lines end with LF or CR LF; in a text without any LF, with CR. A file's last line needs no end.
/// A byte order mark at the start is skipped. The text must outlive the cursor.
class TextCursor {
 public:
  struct Syntax {
    /// A word that begins with '#' and all that follows it on its line are a comment.
    bool comments = false;
    /// A '\' at the end of a line joins the next line to it.
    bool continuation = false;
  };

  TextCursor(std::string_view text, const std::string& file, Syntax syntax, char line_end,
             std::uint64_t first_line = 1)
      : at_(text.data()),
        end_(text.data() + text.size()),
        file_(&file),
        syntax_(syntax),
        line_end_(line_end),
        line_(first_line) {}
  TextCursor(std::string_view text, const std::string& file, Syntax syntax)
      : TextCursor(without_mark(text), file, syntax, line_end_of(text)) {}

  static char line_end_of(std::string_view text) {
    const bool carriage = text.find('\n') == text.npos && text.find('\r') != text.npos;
    return carriage ? '\r' : '\n';
  }
  static std::string_view without_mark(std::string_view text) {
    return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
  }

  [[nodiscard]] bool at_end() const { return at_ == end_; }
  [[nodiscard]] const char* position() const { return at_; }
  [[nodiscard]] std::uint64_t line() const { return line_; }
  [[nodiscard]] std::size_t rest() const { return static_cast<std::size_t>(end_ - at_); }

  /// Skips blanks; true if nothing more is on the line (a comment is nothing).
  [[gnu::always_inline]] bool at_line_end() {  // once a word: 8 % of the time to read an OBJ
    while (at_ != end_) {
      const char c = *at_;
      if (c == line_end_ || (c == '#' && syntax_.comments)) return true;
      if (c == '\\' && syntax_.continuation && skip_line_join()) continue;
      if (!is_blank(c)) return false;
      ++at_;
    }
    return true;
  }

  /// Goes to the start of the next line.
  void skip_line() {
    if (at_ != end_ && *at_ == line_end_) {  // a line that has been read to its end: most
      ++at_;
      ++line_;
      return;
    }
    while (true) {
      const void* found = std::memchr(at_, line_end_, static_cast<std::size_t>(end_ - at_));
      if (!found) {
        at_ = end_;
        return;
      }
      const char* line_end = static_cast<const char*>(found);
      const bool joined = syntax_.continuation && joins(at_, line_end);
      at_ = line_end + 1;
      ++line_;
      if (!joined) return;
    }
  }

  /// Goes to the next line that has a word on it; false at the end of the text.
  bool next_line_with_words() {
    while (at_ != end_) {
      if (!at_line_end()) return true;
      skip_rest_of_comment();
    }
    return false;
  }

  /// The unread rest of this line and of the lines joined to it, unchanged, with comments and with
  /// the '\' that joins lines. The cursor does not move.
  [[nodiscard]] std::string_view rest_of_line() const;

  /// The next word of this line; empty at its end.
  [[gnu::always_inline]] std::string_view word() {
    if (at_line_end()) return {};
    // A '\' that joins nothing ends a word, and begins the next: no word is empty.
    const char* first = at_++;
    while (at_ != end_ && !ends_word(*at_)) ++at_;
    return {first, static_cast<std::size_t>(at_ - first)};
  }

  /// The next word as a finite decimal, rounded once to Real; an exponent may have the letter D, as
  /// Fortran writes it. `what` names it in the error.
  template <class Real>
  Real number(const char* what) {
    if (at_line_end()) fail_missing(what);
    DecimalResult<Real> result = parse_decimal<Real>(at_, end_);
    if (result.fault != DecimalFault::none || !at_word_end(result.end)) {
      result = reread<Real>();
      if (result.fault != DecimalFault::none) fail_number(what, result.fault);
    }
    at_ = result.end;
    return result.value;
  }

  /// number() for attributes, where "nan" and "inf" are accepted, and "1.#IND" and the like as
  /// Windows writes them: programs have them for the normals of degenerate triangles.
  template <class Real>
  Real attribute(const char* what) {
    if (at_line_end()) fail_missing(what);
    const DecimalResult<Real> result = parse_attribute<Real>();
    if (result.fault != DecimalFault::none) fail_number(what, result.fault);
    at_ = result.end;
    return result.value;
  }

  /// attribute() if the next word of the line is one; otherwise nothing, and nothing is read.
  template <class Real>
  std::optional<Real> optional_attribute() {
    if (at_line_end()) return std::nullopt;
    const DecimalResult<Real> result = parse_attribute<Real>();
    if (result.fault != DecimalFault::none) return std::nullopt;
    at_ = result.end;
    return result.value;
  }

  /// The next word as an integer.
  std::int64_t integer(const char* what) {
    if (at_line_end()) fail_missing(what);
    std::int64_t value = 0;
    const char* end = parse_integer(at_, end_, value);
    if (!end || !at_word_end(end)) fail_integer(what);
    at_ = end;
    return value;
  }

  /// For words that are read piece by piece: moves to `at`, which lies on the current line.
  void move_to(const char* at) { at_ = at; }
  [[nodiscard]] const char* limit() const { return end_; }
  [[nodiscard]] bool at_word_end(const char* at) const { return at == end_ || ends_word(*at); }

  /// Reads a decimal integer [+-] digits at `first`, and returns the position after it; nullptr if
  /// there is no integer or it does not fit.
  static const char* parse_integer(const char* first, const char* last, std::int64_t& value) {
    constexpr std::size_t most_digits = 18;  // all numbers of this many digits fit
    const char* at = first;
    const DigitRun digits = read_digits(at, last);
    if (digits.count == 0 || digits.count > most_digits)
      return parse_any_integer(first, last, value);
    value = static_cast<std::int64_t>(digits.number);
    return at;
  }

  /// Throws InputError "FILE: line N: message".
  [[noreturn]] void fail(const std::string& message) const { fail_at(line_, message); }
  [[noreturn]] void fail_at(std::uint64_t line, const std::string& message) const;
  /// fail(), with the word at the cursor: "message, found 'WORD'".
  [[noreturn]] void fail_here(const std::string& message);

 private:
  /// parse_integer(), also with a sign or more digits.
  static const char* parse_any_integer(const char* first, const char* last, std::int64_t& value);
  static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
  }
  [[nodiscard]] bool ends_word(char c) const {
    return is_blank(c) || c == line_end_ || (c == '\\' && syntax_.continuation);
  }
  /// Whether the line [first, line_end) ends with a '\' that is not in a comment.
  static bool joins(const char* first, const char* line_end);
  /// At a '\': skips it and the line end after it, if there is one.
  bool skip_line_join();
  void skip_rest_of_comment();
  template <class Real>
  [[nodiscard]] DecimalResult<Real> parse_attribute() const {
    DecimalResult<Real> result = parse_decimal<Real>(at_, end_);
    if (result.fault != DecimalFault::none || !at_word_end(result.end)) {
      result = reread<Real>();
      if (result.fault == DecimalFault::not_finite) result.fault = DecimalFault::none;
    }
    return result;
  }
  /// The whole word at the cursor as a number in any of the ways in which programs write it.
  template <class Real>
  [[nodiscard]] [[gnu::cold]] DecimalResult<Real> reread() const;
  [[noreturn]] void fail_missing(const char* what) const;
  [[noreturn]] void fail_number(const char* what, DecimalFault fault);
  [[noreturn]] void fail_integer(const char* what);

  const char* at_;
  const char* end_;
  const std::string* file_;
  Syntax syntax_;
  char line_end_;
  std::uint64_t line_;
};

extern template DecimalResult<float> TextCursor::reread<float>() const;
extern template DecimalResult<double> TextCursor::reread<double>() const;

}  // namespace fathom::text
