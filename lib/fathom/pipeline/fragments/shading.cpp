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
Vector3 reversed(const Vector3& a) {
  return {-a[0], -a[1], -a[2]};
}
/// Scaled to unit length; zero stays zero.
Vector3 unit(const Vector3& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? Vector3{a[0] / length, a[1] / length, a[2] / length} : Vector3{0, 0, 0};
}

template <class Values>
Vector3 vector_at(const Values& a, std::size_t place) {
  return {static_cast<double>(a[place]), static_cast<double>(a[place + 1]),
          static_cast<double>(a[place + 2])};
}

}  // namespace

Lighting lighting_of(const Camera& camera, const PipelineOptions& options) {
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
  // Scaled first, so that no length is too great or too small for its square.
  const auto& [x, y, z] = options.light.towards;
  const double greatest = std::max({std::abs(x), std::abs(y), std::abs(z)});
  const Vector3 towards{x / greatest, y / greatest, z / greatest};
  lighting.towards_light = unit(options.light.in_world ? towards : to_world(towards));
  lighting.orthographic = camera.projection == Projection::orthographic;
  lighting.eye =
      lighting.orthographic ? unit(to_world({0, 0, -1})) : to_world({-m[0][3], -m[1][3], -m[2][3]});
  lighting.mirrored = ((camera.fx < 0) != (camera.fy < 0)) !=
                      (determinant_of_rotation(camera).sign() == Sign::negative);
  lighting.material = options.material;
  return lighting;
}

Light light_at(const Lighting& lighting, const Vector3& point, const Vector3& normal) {
  const Material& m = lighting.material;
  const Vector3 N = unit(normal);
  const Vector3& L = lighting.towards_light;
  const double lambert = dot(N, L);
  if (!(lambert > 0)) return {m.ambient, 0};
  const Vector3 V = lighting.orthographic ? lighting.eye : unit(minus(lighting.eye, point));
  double highlight = 0;
  if (m.highlight == SpecularModel::blinn) {
    highlight = dot(N, unit({L[0] + V[0], L[1] + V[1], L[2] + V[2]}));
  } else {
    const Vector3 mirrored{2 * lambert * N[0] - L[0], 2 * lambert * N[1] - L[1],
                           2 * lambert * N[2] - L[2]};
    highlight = dot(mirrored, V);
  }
  return {m.ambient + m.diffuse * lambert,
          m.specular * std::pow(std::max(0.0, highlight), m.shininess)};
}

template <class Real>
void light_corners(std::vector<ClipVertex<Real>>& corners, const Lighting& lighting) {
  for (ClipVertex<Real>& corner : corners) {
    auto& a = corner.attributes;
    const Vector3 point = vector_at(a, attribute::world);
    const Vector3 normal = vector_at(a, attribute::normal);
    const auto keep = [&](std::size_t place, const Light& light) {
      a[place] = static_cast<Real>(light.diffuse);
      a[place + 1] = static_cast<Real>(light.specular);
    };
    keep(attribute::front_light, light_at(lighting, point, normal));
    keep(attribute::back_light, light_at(lighting, point, reversed(normal)));
  }
}

template <class Real>
Shader<Real>::Shader(const Camera& camera, const PipelineOptions& options,
                     std::optional<Texture> texture)
    : options_(options), lighting_(lighting_of(camera, options)), texture_(std::move(texture)) {}

template <class Real>
void Shader<Real>::begin(const WindowTriangle<Real>& t) {
  shows_normals_ = pipeline::shows_normals(t.front, lighting_);
  if (options_.shading == Shading::flat) {
    const Vector3 a = vector_at(t.face[0], 0), b = vector_at(t.face[1], 0),
                  c = vector_at(t.face[2], 0);
    // It is on the side from which the corners run counter-clockwise.
    const Vector3 normal = cross(minus(b, a), minus(c, a));
    const bool is_seen = shows_normals_ == (options_.front_face == FrontFace::counter_clockwise);
    const Vector3 centre{(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3,
                         (a[2] + b[2] + c[2]) / 3};
    light_[0] = light_at(lighting_, centre, is_seen ? normal : reversed(normal));
  } else if (options_.shading == Shading::gouraud) {
    const std::size_t place = shows_normals_ ? attribute::front_light : attribute::back_light;
    for (std::size_t k = 0; k < 3; ++k)
      light_[k] = {static_cast<double>(t.corners[k].attributes[place]),
                   static_cast<double>(t.corners[k].attributes[place + 1])};
  }
}

template <class Real>
Light Shader<Real>::light(const Fragment& f, const std::array<Real, 3>& weights) const {
  switch (options_.shading) {
    case Shading::flat:
      return light_[0];
    case Shading::gouraud: {
      Light light;
      for (std::size_t k = 0; k < 3; ++k) {
        light.diffuse += static_cast<double>(weights[k]) * light_[k].diffuse;
        light.specular += static_cast<double>(weights[k]) * light_[k].specular;
      }
      return light;
    }
    case Shading::phong: {
      const Vector3 normal = vector_at(f.attributes, attribute::normal);
      return light_at(lighting_, vector_at(f.attributes, attribute::world),
                      shows_normals_ ? normal : reversed(normal));
    }
    default:
      return {1, 0};
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
  const Light received = light(f, weights);
  for (double& c : colour) c = std::clamp(c * received.diffuse + received.specular, 0.0, 1.0);
  return colour;
}

template void light_corners(std::vector<ClipVertex<float>>&, const Lighting&);
template void light_corners(std::vector<ClipVertex<double>>&, const Lighting&);
template class Shader<float>;
template class Shader<double>;

}  // namespace fathom::pipeline
