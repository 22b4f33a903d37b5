#pragma once

#include <cstdlib>
#include <string_view>

namespace fathom::fuzz {

/// Ends the program unless a message is one line.
inline void expect_one_line(std::string_view message) {
  if (message.empty() || message.find('\n') != std::string_view::npos) std::abort();
}

}  // namespace fathom::fuzz
