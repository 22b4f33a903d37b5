#include "validation/report/cause.h"

namespace fathom::validation {

std::string pixel_text(const ValidationCase& c, std::size_t pixel) {
  return attribution::pixel_text(*c.truth, c.other, c.attribution, pixel);
}

std::string cause_of(const ValidationCase& c) {
  return c.is_done() ? attribution::cause_of(*c.truth, c.other, c.attribution) : c.failure;
}

}  // namespace fathom::validation
