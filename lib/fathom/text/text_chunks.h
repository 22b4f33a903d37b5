#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

namespace fathom::text {

/// Cuts text behind line ends into pieces of about `size` bytes; a line that a '\' joins to the
/// next is not cut from it. Where the cuts are does not depend on the number of threads.
std::vector<std::string_view> cut_into_chunks(std::string_view text, char line_end,
                                              std::size_t size);

/// Runs body(0) … body(n−1) on up to `threads` threads (0: all). Of those that throw, the one of
/// the lowest number is heard: the first error in the file.
void for_each_chunk(std::size_t n, int threads, const std::function<void(std::size_t)>& body);

}  // namespace fathom::text
