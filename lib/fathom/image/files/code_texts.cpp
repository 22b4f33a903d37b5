#include "fathom/image/files/code_texts.h"

#include <charconv>
#include <cmath>

#include "fathom/failures/errors.h"

namespace fathom::image {

double read_scale(const std::string& text, const std::string& name) {
  double scale = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), scale);
  if (error != std::errc() || end != text.data() + text.size() || !(scale > 0) ||
      !std::isfinite(scale)) {
    throw InputError(name + ": its fathom:scale is '" + text.substr(0, 40) +
                     "': expected a positive number");
  }
  return scale;
}

}  // namespace fathom::image
