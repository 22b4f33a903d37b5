#pragma once

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

}  // namespace fathom::studies
