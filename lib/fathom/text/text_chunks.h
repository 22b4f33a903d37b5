#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

namespace fathom::text {

/// Cuts text after line ends into pieces of about `size` bytes; a line is not cut off from the next
/// if a '\' joins them. Where the cuts are does not depend on the number of threads.
std::vector<std::string_view> cut_into_chunks(std::string_view text, char line_end,
                                              std::size_t size);

/// Runs body(0) … body(n−1) on up to `threads` threads (0: all). If several throw, the exception of
/// the lowest number is passed on: the first error in the file.
void for_each_chunk(std::size_t n, int threads, const std::function<void(std::size_t)>& body);

}  // namespace fathom::text
