#pragma once

#include <string>
#include <string_view>

/// What lies before and behind the text of some files.
namespace fathom::text {

/// The text without zero bytes and a Control-Z behind its last line, which programs leave there
/// that write whole buffers, or for CP/M. One of them may stand behind the last word. More of them
/// there may stand for what is lost of it and are kept: they are no part of a word or number.
std::string_view without_padding(std::string_view text);

/// The text without the zero bytes behind it: some exporters pad the JSON of a GLB with them, where
/// glTF has spaces.
std::string_view without_zeros(std::string_view text);

/// Fails    InputError if the text is in UTF-16, with a byte order mark or without.
void expect_no_utf16(std::string_view text, const std::string& file);

}  // namespace fathom::text
