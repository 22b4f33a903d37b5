#include "fathom/pipeline/fragments/shading.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/geometry/eigen_arrays.h"
#include "fathom/image/preview.h"
#include "fathom/pipeline/geometry/primitive_assembly.h"

namespace fathom::pipeline {
namespace {

using Vector = Eigen::Vector3d;

using geometry::as_array;
using geometry::as_vector;

template <class Values>
Vector vector_at(const Values& a, std::size_t place) {
  return {static_cast<double>(a[place]), static_cast<double>(a[place + 1]),
          static_cast<double>(a[place + 2])};
}

}  // namespace

std::optional<Texture> texture_of(const Scene& scene, const PipelineOptions& options) {
  if (options.texture.empty()) return std::nullopt;
  Texture texture =
      options.texture == "checker" ? Texture::checker() : Texture(read_rgb_png(options.texture));
  if (!has_texture_coordinates(scene))
    throw InputError(Setting{"texture"}, "the scene has no texture coordinates at some corners");
  return texture;
}

Lighting lighting_of(const Camera& camera, const PipelineOptions& options) {
  const auto camera_from_world = geometry::as_matrix(camera.world_to_camera);
  // The camera's axes in the world are the rows of a rotation; for another matrix, the images of
  // the axes under its inverse.
  const Eigen::PartialPivLU<Eigen::Matrix3d> rotation(camera_from_world.leftCols<3>());
  const auto to_world = [&](const Vector& c) -> Vector { return rotation.solve(c); };
  Lighting lighting;
  // Scaled first, so that no length is too great or too small for its square.
  const Vector given = as_vector(options.light.towards);
  const Vector towards = given / given.cwiseAbs().maxCoeff();
  lighting.towards_light =
      as_array((options.light.in_world ? towards : to_world(towards)).normalized());
  lighting.orthographic = is_orthographic(camera.projection);
  lighting.eye = as_array(lighting.orthographic ? to_world({0, 0, -1}).normalized()
                                                : to_world(-camera_from_world.col(3)));
  lighting.mirrored = is_mirrored(camera.projection) !=
                      (determinant_of_rotation(camera.world_to_camera).sign() == Sign::negative);
  lighting.material = options.material;
  return lighting;
}

Light light_at(const Lighting& lighting, const Vector3& point, const Vector3& normal) {
  const Material& m = lighting.material;
  const Vector N = as_vector(normal).normalized();  // zero remains zero
  const Vector L = as_vector(lighting.towards_light);
  const double lambert = N.dot(L);
  if (!(lambert > 0)) return {m.ambient, 0};
  const Vector eye = as_vector(lighting.eye);
  const Vector V = lighting.orthographic ? eye : (eye - as_vector(point)).normalized();
  const double highlight = m.highlight == SpecularModel::blinn ? N.dot((L + V).normalized())
                                                               : (2 * lambert * N - L).dot(V);
  return {m.ambient + m.diffuse * lambert,
          m.specular * std::pow(std::max(0.0, highlight), m.shininess)};
}

template <class Real>
void light_corners(std::vector<ClipVertex<Real>>& corners, const Lighting& lighting) {
  for (ClipVertex<Real>& corner : corners) {
    auto& a = corner.attributes;
    const Vector3 point = as_array(vector_at(a, attribute::world));
    const Vector normal = vector_at(a, attribute::normal);
    const auto keep = [&](std::size_t place, const Light& light) {
      a[place] = static_cast<Real>(light.diffuse);
      a[place + 1] = static_cast<Real>(light.specular);
    };
    keep(attribute::front_light, light_at(lighting, point, as_array(normal)));
    keep(attribute::back_light, light_at(lighting, point, as_array(-normal)));
  }
}

template <class Real>
Shader<Real>::Shader(const Camera& camera, const PipelineOptions& options,
                     std::optional<Texture> texture)
    : options_(options), lighting_(lighting_of(camera, options)), texture_(std::move(texture)) {}

template <class Real>
void Shader<Real>::begin(const WindowTriangle<Real>& t) {
  shows_normals_ = pipeline::shows_normals(t.front, lighting_);
  if (options_.colours != SurfaceColours::file) {
    const Rgb rgb =
        colour_of_identifier(options_.colours == SurfaceColours::object ? t.object : t.number);
    number_colour_ = {rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0};
  }
  if (options_.shading == Shading::flat) {
    const Vector a = vector_at(t.face[0], 0), b = vector_at(t.face[1], 0),
                 c = vector_at(t.face[2], 0);
    // It is on the side from which the corners run counter-clockwise.
    const Vector normal = (b - a).cross(c - a);
    const bool is_seen = shows_normals_ == (options_.front_face == FrontFace::counter_clockwise);
    const Vector centre = (a + b + c) / 3;
    light_[0] = light_at(lighting_, as_array(centre), as_array(is_seen ? normal : -normal));
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
      const Vector normal = vector_at(f.attributes, attribute::normal);
      return light_at(lighting_, as_array(vector_at(f.attributes, attribute::world)),
                      as_array(shows_normals_ ? normal : -normal));
    }
    default:
      return {1, 0};
  }
}

template <class Real>
Colour Shader<Real>::shade(const Fragment& f, const std::array<Real, 3>& weights) const {
  Colour colour =
      number_colour_ ? *number_colour_ : as_array(vector_at(f.attributes, attribute::colour));
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
