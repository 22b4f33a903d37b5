#include <array>
#include <cmath>
#include <numbers>

#include "validation/scenes/made/made_meshes.h"
#include "validation/scenes/made/mesh_building.h"
#include "validation/scenes/made/random.h"
#include "validation/scenes/shapes.h"

namespace fathom::bench {
namespace {

struct Octave {
  double frequency, amplitude;
};
constexpr std::array<Octave, 6> bumps{
    {{1.6, 0.2}, {3.7, 0.08}, {8.1, 0.03}, {17, 0.013}, {39, 0.006}, {83, 0.003}}};

/// A direction moved along the sphere, so that vertices crowd in some places and spread in others.
Vector3 crowded(const Vector3& p) {
  const Vector3 q = 1.9 * p;
  return unit(p + 0.3 * Vector3{value_noise(q, 101), value_noise(q, 102), value_noise(q, 103)});
}

/// The distance of the surface from the origin.
double radius(const Vector3& direction) {
  double sum = 1;
  std::uint64_t seed = 0;
  for (const Octave& octave : bumps) {
    sum += octave.amplitude * value_noise(octave.frequency * direction, ++seed);
  }
  return sum;
}

/// Whether the scanner did not see the surface around a point.
bool unseen(const MeshPoint& point) {
  const Vector3 p{point.x, point.y, point.z};
  return value_noise(2.3 * p, 201) > 0.62 || value_noise(11.0 * p, 202) > 0.8;
}

void leave_out_unseen(Mesh& mesh, Random& random) {
  std::size_t kept = 0;
  for (const CornerIndices& t : mesh.triangles) {
    if (unseen(mesh.vertices[t[0]]) || random() < 0.001) continue;
    mesh.triangles[kept++] = t;
  }
  mesh.triangles.resize(kept);
}

}  // namespace

Mesh scan(std::uint64_t triangles) {
  Mesh mesh = sphere(triangles);
  Random random(31);
  // A fifth of the length of an edge.
  const double noise = 0.2 * std::sqrt(4 * std::numbers::pi / static_cast<double>(triangles));
  for (MeshPoint& point : mesh.vertices) {
    const Vector3 direction = crowded({point.x, point.y, point.z});
    const Vector3 p = (radius(direction) + random.between(-noise, noise)) * direction;
    point = {p[0], p[1], p[2]};
  }
  leave_out_unseen(mesh, random);
  return mesh;
}

}  // namespace fathom::bench
