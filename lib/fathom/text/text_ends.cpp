#include "fathom/text/text_ends.h"

#include <exception>

#include "fathom/failures/errors.h"
#include "fathom/threads/threads.h"

namespace fathom::text {
namespace {

bool is_ascii(char c) {
  return c > 0 && c < 127;
}

/// Whether, of the first four bytes, every other byte is zero and the rest are characters of ASCII.
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

std::vector<std::string_view> cut_into_chunks(std::string_view text, char line_end,
                                              std::size_t size) {
  std::vector<std::string_view> chunks;
  const auto is_joined = [&](std::size_t end) {  // text[end] is a line end
    if (end > 0 && text[end - 1] == '\r') --end;
    return end > 0 && text[end - 1] == '\\';
  };
  while (!text.empty()) {
    std::size_t end = text.size() <= size ? text.npos : text.find(line_end, size);
    while (end != text.npos && is_joined(end)) end = text.find(line_end, end + 1);
    const std::size_t length = end == text.npos ? text.size() : end + 1;
    chunks.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
  return chunks;
}

void for_each_chunk(std::size_t n, int threads, const std::function<void(std::size_t)>& body) {
  std::vector<std::exception_ptr> failures(n);
  const auto guarded = [&](std::size_t i) {
    try {
      body(i);
    } catch (...) {
      failures[i] = std::current_exception();
    }
  };
  if (n == 1) {
    guarded(0);
  } else if (n > 1) {
    run_with_threads(threads, [&] { in_parallel(n, guarded); });
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace fathom::text
