#include "fathom/attribution/model/opengl_drivers.h"

namespace fathom::attribution {

bool interpolates_before_snapping(const std::string& description) {
  return description.find("llvmpipe") != std::string::npos;
}

}  // namespace fathom::attribution
