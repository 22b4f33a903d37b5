#include "fathom/mesh/element_counts.h"

#include "fathom/failures/errors.h"

namespace fathom::mesh {

void expect_countable(std::uint64_t count, const char* what, const std::string& file) {
  if (count > most_elements)
    throw InputError(file + ": " + std::to_string(count) + " " + what +
                     " are more than the 4294967294 that can be numbered");
}

void fail_too_many_triangles(const std::string& file) {
  throw InputError(file + ": more than the 4294967294 triangles that can be numbered");
}

}  // namespace fathom::mesh
