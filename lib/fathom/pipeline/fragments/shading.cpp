#include "fathom/pipeline/fragments/shading.h"

#include <algorithm>
#include <cmath>

namespace fathom::pipeline {
namespace {

double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector3 minus(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Scaled to unit length; zero stays zero.
Vector3 unit(const Vector3& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? Vector3{a[0] / length, a[1] / length, a[2] / length} : Vector3{0, 0, 0};
}

template <class Real>
Vector3 vector_at(const Attributes<Real>& a, std::size_t place) {
  return {static_cast<double>(a[place]), static_cast<double>(a[place + 1]),
          static_cast<double>(a[place + 2])};
}

}  // namespace

Lighting lighting_of(const Camera& camera) {
  // The rows of a rotation are the camera's axes in the world; for another matrix, use the
  // directions that its inverse takes there.
  const auto& m = camera.world_to_camera;
  const Vector3 r0{m[0][0], m[0][1], m[0][2]}, r1{m[1][0], m[1][1], m[1][2]},
      r2{m[2][0], m[2][1], m[2][2]};
  const double determinant = dot(r0, cross(r1, r2));
  const auto to_world = [&](const Vector3& c) {
    const Vector3 x = cross(r1, r2), y = cross(r2, r0), z = cross(r0, r1);
    Vector3 p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = (x[k] * c[0] + y[k] * c[1] + z[k] * c[2]) / determinant;
    return p;
  };
  Lighting lighting;
  lighting.towards_light = unit(to_world({-0.45, -0.65, -1}));
  lighting.orthographic = camera.projection == Projection::orthographic;
  lighting.eye =
      lighting.orthographic ? unit(to_world({0, 0, -1})) : to_world({-m[0][3], -m[1][3], -m[2][3]});
  return lighting;
}

Light light_at(const Lighting& lighting, const Vector3& point, const Vector3& normal) {
  const Vector3 V = lighting.orthographic ? lighting.eye : unit(minus(lighting.eye, point));
  Vector3 N = unit(normal);
  if (dot(N, V) < 0) N = {-N[0], -N[1], -N[2]};
  const Vector3& L = lighting.towards_light;
  const Vector3 H = unit({L[0] + V[0], L[1] + V[1], L[2] + V[2]});
  const double lambert = std::max(0.0, dot(N, L));
  return {0.15 + 0.75 * lambert, lambert > 0 ? 0.25 * std::pow(std::max(0.0, dot(N, H)), 40) : 0};
}

template <class Real>
Shader<Real>::Shader(const Camera& camera, const PipelineOptions& options,
                     std::optional<Texture> texture)
    : options_(options), lighting_(lighting_of(camera)), texture_(std::move(texture)) {}

template <class Real>
void Shader<Real>::begin(const WindowTriangle<Real>& t) {
  std::array<Vector3, 3> world;
  for (std::size_t k = 0; k < 3; ++k)
    world[k] = vector_at(t.corners[k].attributes, attribute::world);
  if (options_.shading == Shading::flat) {
    const Vector3 normal = cross(minus(world[1], world[0]), minus(world[2], world[0]));
    const Vector3 centre{(world[0][0] + world[1][0] + world[2][0]) / 3,
                         (world[0][1] + world[1][1] + world[2][1]) / 3,
                         (world[0][2] + world[1][2] + world[2][2]) / 3};
    light_[0] = light_at(lighting_, centre, normal);
  } else if (options_.shading == Shading::gouraud) {
    for (std::size_t k = 0; k < 3; ++k)
      light_[k] =
          light_at(lighting_, world[k], vector_at(t.corners[k].attributes, attribute::normal));
  }
}

template <class Real>
Colour Shader<Real>::shade(const Fragment& f, const std::array<Real, 3>& weights) const {
  Colour colour = vector_at(f.attributes, attribute::colour);
  if (texture_) {
    const Colour texel = texture_->sample(
        {{f.attributes[attribute::uv], f.attributes[attribute::uv + 1]}, f.duv_dx, f.duv_dy},
        options_.filter);
    for (std::size_t k = 0; k < 3; ++k) colour[k] *= texel[k];
  }
  Light light{1, 0};
  if (options_.shading == Shading::flat) light = light_[0];
  if (options_.shading == Shading::phong)
    light = light_at(lighting_, vector_at(f.attributes, attribute::world),
                     vector_at(f.attributes, attribute::normal));
  if (options_.shading == Shading::gouraud) {
    light = {0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      light.diffuse += static_cast<double>(weights[k]) * light_[k].diffuse;
      light.specular += static_cast<double>(weights[k]) * light_[k].specular;
    }
  }
  for (double& c : colour) c = std::clamp(c * light.diffuse + light.specular, 0.0, 1.0);
  return colour;
}

template class Shader<float>;
template class Shader<double>;

}  // namespace fathom::pipeline
