#pragma once

#include <cctype>
#include <cstddef>
#include <string>

#include "fathom/text/printable.h"

namespace fathom::mesh_files::formats_program {

/// What a library says of a file, as the end of a one-line message: it can be long, and of several
/// lines.
inline std::string as_reason(std::string text) {
  constexpr std::size_t longest = 300;
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  if (text.size() > longest) text = text.substr(0, longest) + "…";
  return text::printable(std::move(text));
}

}  // namespace fathom::mesh_files::formats_program
