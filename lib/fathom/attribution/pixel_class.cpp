#include "fathom/attribution/pixel_class.h"

namespace fathom::attribution {

std::string name_of(PixelClass pixel_class) {
  constexpr const char* names[] = {
      "equal",   "within quantization", "within arithmetic", "edge",
      "z-fight", "missed surface",      "convention",        "unexplained"};
  return names[static_cast<std::size_t>(pixel_class)];
}

}  // namespace fathom::attribution
