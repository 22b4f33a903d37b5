#pragma once

#include <optional>

#include "fathom/pipeline/fragments/fragment.h"
#include "fathom/pipeline/fragments/texture.h"

/// Fragment stage: the colour of a fragment. Colours are numbers from 0 to 1 that are written to
/// pictures as they are, rounded to 8 bits.
namespace fathom::pipeline {

using Vector3 = std::array<double, 3>;

/// The texture that the options name; none if they name none.
/// Fails    InputError where it cannot be read, or the scene has no coordinates for it.
std::optional<Texture> texture_of(const Scene& scene, const PipelineOptions& options);

/// A light that comes from everywhere in one direction, the eye, and what surfaces do with light.
struct Lighting {
  Vector3 towards_light{0, 0, 1};  ///< unit, in the world
  Vector3 eye{0, 0, 0};            ///< in the world; a direction if orthographic
  bool orthographic = false;
  /// The camera shows a mirror image, in which what runs counter-clockwise runs clockwise.
  bool mirrored = false;
  Material material;
};
Lighting lighting_of(const Camera& camera, const PipelineOptions& options);

/// Light on a point of a surface: Lambert's, and a highlight where Lambert's is not 0.
///
/// Frame    world. `normal`, of any length, is that of the side that is seen; without one (0) there
///          is ambient light alone. A highlight's cosine below 0 counts as 0.
/// Error    a few ulp of binary64; (cosine)^shininess, shininess times that.
/// Source   [Bli77], [Pho75]
struct Light {
  double diffuse = 0, specular = 0;  ///< to be multiplied by the surface's colour; to be added
};
Light light_at(const Lighting& lighting, const Vector3& point, const Vector3& normal);

/// Gouraud's light, where it is computed: at the corners of the mesh, before anything is cut, for
/// either side of the surface.
template <class Real>
void light_corners(std::vector<ClipVertex<Real>>& corners, const Lighting& lighting);

/// Whether a triangle shows the side on which its corners' normals are. That is a matter of the
/// whole triangle: normals that lean away from the eye are not turned one by one.
inline bool shows_normals(bool front_as_displayed, const Lighting& lighting) {
  return front_as_displayed != lighting.mirrored;
}

/// Shades fragments of one triangle after another.
template <class Real>
class Shader {
 public:
  Shader(const Camera& camera, const PipelineOptions& options, std::optional<Texture> texture);

  /// What is found once per triangle: the colour of its number, the side that is seen, the face's
  /// light (flat: at the centre of the whole triangle, with the normal of its plane), the corners'
  /// light (Gouraud).
  void begin(const WindowTriangle<Real>& triangle);
  [[nodiscard]] Colour shade(const Fragment& fragment, const std::array<Real, 3>& weights) const;
  /// The light that shade() gives the surface.
  [[nodiscard]] Light light(const Fragment& fragment, const std::array<Real, 3>& weights) const;
  [[nodiscard]] bool shows_normals() const { return shows_normals_; }

 private:
  PipelineOptions options_;
  Lighting lighting_;
  std::optional<Texture> texture_;
  std::array<Light, 3> light_{};
  std::optional<Colour> number_colour_;  ///< instead of that of the vertices
  bool shows_normals_ = true;
};

}  // namespace fathom::pipeline
