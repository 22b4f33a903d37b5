#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace fathom::app {

/// Columns of a UTF-8 text whose characters take one each.
std::size_t columns(const std::string& text);

/// The parts of a text between empty lines.
std::vector<std::string> paragraphs_of(const std::string& text);

/// The words of a text in lines of at most `width` columns, where words are not longer than that.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);

}  // namespace fathom::app
