#pragma once

#include <string>

namespace fathom::text {

/// A text as it can stand in a one-line message: each control character of ASCII becomes '?'.
std::string printable(std::string text);

}  // namespace fathom::text
