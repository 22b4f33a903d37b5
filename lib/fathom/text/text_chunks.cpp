#include "fathom/text/text_chunks.h"

#include <exception>

#include "fathom/threads/threads.h"

namespace fathom::text {

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
