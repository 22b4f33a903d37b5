#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/rays/ray.h"
#include "fathom/scene/scene.h"

/// Scenes and rays in which much coincides or is out of proportion.
namespace fathom::rays::test {

struct RayCase {
  Scene scene;
  std::vector<Ray> rays;
  CastOptions options;
};

struct Family {
  std::string name;
  RayCase (*draw)(std::uint64_t seed);
};

/// Families, each a list of cases by seed.
const std::vector<Family>& families();

}  // namespace fathom::rays::test
