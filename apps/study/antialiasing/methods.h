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

/// Scenes with exact pictures, and how well each method of antialiasing draws them.
namespace fathom::studies {

/// A scene for the pipeline, and its exact picture.
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
/// A checkerboard plane that runs to the horizon, as a texture, 240 × 160. The exact picture is
/// drawn with its squares as triangles.
Judged checkered_plane();
/// A checkerboard that fills the picture, turned and 96 × 96. Its only edges are edges of the
/// texture.
Judged checkered_wall();
/// Letters whose dots are pixels: a picture that needs no antialiasing.
Judged text();

// Pictures by every kind of antialiasing that the pipeline has, against exact areas.

/// The error of a picture against the exact picture: differences of colour, 1 from black to white,
/// as means of the three components.
struct PictureError {
  double mean = 0, rms = 0, greatest = 0;
};
PictureError error_of(const pipeline::ColourImage& image, const pipeline::ColourImage& truth);

struct MethodError {
  std::string name;
  PictureError star, sheets;
  /// Errors of the checkered plane and wall, and of the letters, which are correct without
  /// antialiasing.
  PictureError plane, wall, text;
  double ms = 0;             ///< for the star, here: the least of several frames
  std::uint64_t shaded = 0;  ///< for the star
  /// The peak memory of a frame of 192 × 192 pixels on this machine, for each pixel; nullopt if the
  /// system does not measure it.
  std::optional<double> bytes_a_pixel;
};

struct FilterError {
  std::string filter;
  double mean = 0;  ///< of the checkered plane, one sample a pixel
};

struct AntialiasingMethods {
  std::vector<MethodError> methods;
  std::vector<FilterError> filters;
  /// The share of the pixels of the checkered wall that FXAA changes, although no edge of a
  /// triangle is visible.
  double texture_changed_by_fxaa = 0;
  /// star-METHOD, sheets-METHOD, filter-FILTER, wall-, text- and plane-truth, …, each with its
  /// width on the page.
  std::vector<std::pair<StudyFile, std::uint32_t>> pictures;
  std::vector<StudyFile> files;  ///< the scenes and cameras that they are drawn from
};

/// Measures all methods with the pipeline's defaults: binary32, and 8 subpixel bits unless the name
/// contains other bits.
AntialiasingMethods measure_antialiasing(const std::function<void(double)>& tick);

}  // namespace fathom::studies
