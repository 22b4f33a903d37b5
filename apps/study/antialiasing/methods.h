#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/study/study.h"
#include "fathom/camera/camera.h"
#include "fathom/pipeline/output/output_merger.h"
#include "fathom/scene/scene.h"

/// Scenes whose pictures are known exactly, to judge antialiasing by.
namespace fathom::studies {

/// What the pipeline draws, and what it should look like.
struct Judged {
  Scene scene;
  Camera camera;
  bool textured = false;  ///< with the checkerboard, looked up at the nearest texel
  pipeline::ColourImage truth;
};

/// A star of 36 white rays, 128 × 128: edges of every slope, finer than a pixel in the middle.
Judged star();
/// Two triangles of many colours that go through each other, 128 × 128: sheets of 8 × 8 parts.
Judged crossing_sheets();
/// A checkerboard plane that runs to the horizon, as a texture, 240 × 160. The truth is that of its
/// squares as triangles.
Judged checkered_plane();
/// A checkerboard that fills the picture, turned and 96 × 96: edges of a texture and of nothing
/// else.
Judged checkered_wall();
/// Letters whose every dot is one pixel: a picture that is right as it is.
Judged text();

// Pictures by every kind of antialiasing that the pipeline has, against exact areas.

/// How far a picture is from the exact one: differences of colour, 1 from black to white, as means
/// of the three components.
struct PictureError {
  double mean = 0, rms = 0, greatest = 0;
};
PictureError error_of(const pipeline::ColourImage& image, const pipeline::ColourImage& truth);

struct MethodError {
  std::string name;
  PictureError star, sheets;
  /// Of the checkered plane and wall, and of letters that are right without antialiasing.
  PictureError plane, wall, text;
  double ms = 0;             ///< for the star, here: the least of several frames
  std::uint64_t shaded = 0;  ///< for the star
  /// The peak of the memory that a frame of 192 × 192 pixels takes here, for each pixel; nullopt
  /// where the system does not measure it.
  std::optional<double> bytes_a_pixel;
};

struct FilterError {
  std::string filter;
  double mean = 0;  ///< of the checkered plane, one sample a pixel
};

struct AntialiasingMethods {
  std::vector<MethodError> methods;
  std::vector<FilterError> filters;
  /// Of the checkered wall, in which no edge of a triangle is seen: the share of pixels that FXAA
  /// changes all the same.
  double texture_changed_by_fxaa = 0;
  /// star-METHOD, sheets-METHOD, filter-FILTER, wall-, text- and plane-truth, …, each with the
  /// width in which it is shown.
  std::vector<std::pair<StudyFile, std::uint32_t>> pictures;
  std::vector<StudyFile> files;  ///< the scenes and cameras that they are drawn from
};

/// All of them as the pipeline is by default: binary32, and 8 subpixel bits unless the name says
/// others.
AntialiasingMethods measure_antialiasing(const std::function<void(double)>& tick);

}  // namespace fathom::studies
