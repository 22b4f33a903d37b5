#include "fathom/gltf/gltf_placement.h"

#include "fathom/numeric/certified.h"
#include "fathom/text/json_value.h"

namespace fathom::gltf {
using namespace text;

namespace {

/// Sixteen numbers, column by column.
WorldFromMesh read_matrix(const JsonValue& value) {
  const auto m = value.numbers(16);
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
    value.fail("expected the last row of the matrix to be 0 0 0 1");
  WorldFromMesh transform;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) transform.rows[i][k] = m[4 * k + i];
  return transform;
}

template <std::size_t size>
void read_part(const JsonValue& node, const char* key, std::array<double, size>& part) {
  const auto value = node.find(key);
  if (!value) return;
  const std::vector<double> numbers = value->numbers(size);
  std::copy(numbers.begin(), numbers.end(), part.begin());
}

}  // namespace

WorldFromMesh transform_of(const GltfPlacement& placement) {
  const auto& q = placement.rotation;
  const Dyadic x = q[0], y = q[1], z = q[2], w = q[3], one = 1.0;
  const auto twice = [](const Dyadic& a) { return a + a; };
  const std::array<ExactVector3, 3> R{
      {{one - twice(y * y + z * z), twice(x * y - w * z), twice(x * z + w * y)},
       {twice(x * y + w * z), one - twice(x * x + z * z), twice(y * z - w * x)},
       {twice(x * z - w * y), twice(y * z + w * x), one - twice(x * x + y * y)}}};
  WorldFromMesh transform;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) transform.rows[i][k] = R[i][k] * placement.scale[k];
    transform.rows[i][3] = placement.translation[i];
  }
  return transform;
}

WorldFromMesh read_transform_of_node(const JsonValue& node) {
  if (const auto matrix = node.find("matrix")) {
    for (const char* key : {"translation", "rotation", "scale"})
      if (const auto part = node.find(key))
        part->fail("appears together with a matrix, expected only one");
    return read_matrix(*matrix);
  }
  GltfPlacement placement;
  read_part(node, "translation", placement.translation);
  read_part(node, "rotation", placement.rotation);
  read_part(node, "scale", placement.scale);
  return transform_of(placement);
}

}  // namespace fathom::gltf
