#include "fathom/text/percentage.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace fathom::text {

std::string percentage(double share) {
  const double smaller = 100 * std::min(share, 1 - share);
  int decimals = 0;
  if (smaller > 0)
    decimals = smaller < 0.1 ? -static_cast<int>(std::floor(std::log10(smaller))) : 1;
  std::array<char, 400> text{};
  char* const end = std::to_chars(text.data(), text.data() + text.size(), 100 * share,
                                  std::chars_format::fixed, decimals)
                        .ptr;
  return std::string(text.data(), end) + " %";
}

}  // namespace fathom::text
