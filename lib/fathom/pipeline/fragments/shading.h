#pragma once

#include <optional>

#include "fathom/pipeline/fragments/interpolation.h"
#include "fathom/pipeline/fragments/texture.h"

/// Fragment stage: the colour of a fragment. Colours are numbers from 0 to 1 that are written to
/// pictures as they are, rounded to 8 bits.
namespace fathom::pipeline {

using Vector3 = std::array<double, 3>;

/// A light that comes from everywhere in one direction, and the eye.
struct Lighting {
  Vector3 towards_light{0, 0, 1};  ///< unit, in the world
  Vector3 eye{0, 0, 0};            ///< in the world; a direction if orthographic
  bool orthographic = false;
};
/// A light above the camera's left shoulder.
Lighting lighting_of(const Camera& camera);

/// Lambert's diffuse and Blinn and Phong's specular light on a surface point; the normal is turned
/// towards the eye first. Ambient 0.15, diffuse 0.75, specular 0.25 with exponent 40.
/// Source   [Bli77]
struct Light {
  double diffuse = 0, specular = 0;
};
Light light_at(const Lighting& lighting, const Vector3& point, const Vector3& normal);

/// Shades fragments of one triangle after another.
template <class Real>
class Shader {
 public:
  Shader(const Camera& camera, const PipelineOptions& options, std::optional<Texture> texture);

  /// What is computed once per triangle: the face normal's light (flat), the corners' (Gouraud).
  void begin(const WindowTriangle<Real>& triangle);
  [[nodiscard]] Colour shade(const Fragment& fragment, const std::array<Real, 3>& weights) const;

 private:
  PipelineOptions options_;
  Lighting lighting_;
  std::optional<Texture> texture_;
  std::array<Light, 3> light_{};
};

}  // namespace fathom::pipeline
