#include <fathom/gltf/gltf_placement.h>

bool use_gltf() {
  const fathom::gltf::GltfPlacement moved{.translation = {1, 2, 3}};
  return fathom::gltf::transform_of(moved).rows[2][3] == fathom::Dyadic(3.0);
}
