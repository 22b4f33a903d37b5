#pragma once

#include <vector>

#include "apps/study/scene_files.h"

/// Too few samples in space, and in time.
namespace fathom::studies {

/// The outline of antialiasing/curve.h, evaluated for so many pixels: curve-48.obj; and as the
/// pipeline draws it, one sample at each pixel's centre.
struct DrawnCurve {
  SceneFiles files;
  RgbImage picture;
};
DrawnCurve curve_at(std::uint32_t size);

inline constexpr int wheel_pictures = 8;
/// From one picture to the next; almost 30, the distance of two spokes.
inline constexpr int wheel_degrees = 27;

/// A wheel of 12 spokes, one of them red, in 96 × 96 pixels: wheel.obj, wheel.json; and
/// wheel-motion.json, in which it turns to the right through all pictures, one in each unit of
/// time.
SceneFiles wheel_files();
/// What the pipeline draws of the times 0, 1, …
std::vector<RgbImage> wheel_at_instants();
/// The same with the shutter open until the time of the next picture: means of 16.
std::vector<RgbImage> wheel_with_open_shutter();

}  // namespace fathom::studies
