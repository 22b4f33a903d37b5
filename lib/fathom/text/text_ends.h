#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// Whole texts, before their lines are looked at: what lies before and behind them in some files,
/// and where large ones are cut.
namespace fathom::text {

/// The text without trailing zero bytes or a Control-Z after its last line; programs that write
/// whole buffers, or for CP/M, leave them there. A single such byte directly after the last word is
/// removed, too. Several of them there may replace lost characters of the word and are kept: they
/// are not part of a word or number.
std::string_view without_padding(std::string_view text);

/// The text without the zero bytes behind it: some exporters pad the JSON of a GLB with them, where
/// glTF has spaces.
std::string_view without_zeros(std::string_view text);

/// Fails    InputError if the text is in UTF-16, with a byte order mark or without.
void expect_no_utf16(std::string_view text, const std::string& file);

/// Cuts text after line ends into pieces of about `size` bytes; a line is not cut off from the next
/// if a '\' joins them. Where the cuts are does not depend on the number of threads.
std::vector<std::string_view> cut_into_chunks(std::string_view text, char line_end,
                                              std::size_t size);

/// Runs body(0) … body(n−1) on up to `threads` threads (0: all). If several throw, the exception of
/// the lowest number is passed on: the first error in the file.
void for_each_chunk(std::size_t n, int threads, const std::function<void(std::size_t)>& body);

}  // namespace fathom::text
