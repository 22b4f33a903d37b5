#pragma once

#include <optional>

#include "fathom/pipeline/fragments/fragment.h"
#include "fathom/pipeline/fragments/texture.h"

/// Fragment stage: the colour of a fragment. Colours are numbers from 0 to 1 that pictures store
/// without conversion, rounded to 8 bits.
namespace fathom::pipeline {

using Vector3 = std::array<double, 3>;

/// The texture that the options name, if any.
/// Fails    InputError if it cannot be read, or if the scene has no texture coordinates.
std::optional<Texture> texture_of(const Scene& scene, const PipelineOptions& options);

/// A light with the same direction everywhere, the eye, and how surfaces reflect light.
struct Lighting {
  Vector3 towards_light{0, 0, 1};  ///< unit, in the world
  Vector3 eye{0, 0, 0};            ///< in the world; a direction if orthographic
  bool orthographic = false;
  /// Whether the camera shows a mirror image, which turns counter-clockwise corners clockwise.
  bool mirrored = false;
  Material material;
};
Lighting lighting_of(const Camera& camera, const PipelineOptions& options);

/// The light on a point of a surface: Lambert's light, and a highlight where Lambert's light is not
/// 0.
///
/// Frame    world. `normal`, of any length, is the normal of the visible side; without a normal (0)
///          there is ambient light only. A highlight's cosine below 0 counts as 0.
/// Error    a few ulp of binary64; (cosine)^shininess, shininess times that.
/// Source   [Bli77], [Pho75]
struct Light {
  double diffuse = 0, specular = 0;  ///< multiply by the surface's colour; add
};
Light light_at(const Lighting& lighting, const Vector3& point, const Vector3& normal);

/// Gouraud's light, computed at the corners of the mesh, before clipping, for both sides of the
/// surface.
template <class Real>
void light_corners(std::vector<ClipVertex<Real>>& corners, const Lighting& lighting);

/// Whether a triangle shows the side of its corners' normals. This is decided for the whole
/// triangle: single normals that lean away from the eye are not turned.
inline bool shows_normals(bool front_as_displayed, const Lighting& lighting) {
  return front_as_displayed != lighting.mirrored;
}

/// Shades fragments of one triangle after another.
template <class Real>
class Shader {
 public:
  Shader(const Camera& camera, const PipelineOptions& options, std::optional<Texture> texture);

  /// Computes everything that is the same for all fragments of a triangle: the colour of its
  /// number, the visible side, the face's light (flat: at the centre of the whole triangle, with
  /// the normal of its plane), the corners' light (Gouraud).
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
  std::optional<Colour> number_colour_;  ///< instead of the vertices' colours
  bool shows_normals_ = true;
};

}  // namespace fathom::pipeline
