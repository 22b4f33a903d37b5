#include <fathom/failures/unknown_name.h>

bool use_failures() {
  return fathom::nearest_names("naer", {"near", "far"}) == std::vector<std::string>{"near"};
}
