#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/study/study.h"
#include "fathom/camera/camera.h"
#include "fathom/camera/lens.h"
#include "fathom/scene/scene.h"

/// What the study of lenses draws: a scene in the frame of its camera, and lenses by strength.
namespace fathom::studies {

/// A scene in the frame of the camera. Its coordinates, each rounded to binary64, are the truth of
/// the study.
struct LensScene {
  std::string name;
  /// A single mesh with its own corners for each triangle.
  Scene scene;
  /// The object of each triangle in the scene as it was given: its surface.
  std::vector<std::uint32_t> surfaces;
  /// Without a pose, a lens, near or far.
  Camera pinhole;
};

/// Of a perspective camera.
LensScene in_camera_frame(const SceneView& view);

/// A corridor of five walls, with four boxes and two posts in it: surfaces of a few large triangles
/// whose edges are long in the image. All corners lie in front of the camera and inside the lenses
/// of lenses_for(). 320×240 pixels.
SceneView corridor();

/// A lens of strength 1, and its name in tables.
struct StudiedLens {
  std::string name;
  Lens lens;
};
/// The lens with each number of distortion times `strength`.
Lens at_strength(Lens lens, double strength);

/// The lens of the camera, called "camera"; for a pinhole four others, whose numbers fit its field
/// of view: "barrel", whose fold passes through the farthest corner of the image, "pincushion",
/// "decentred" and "rational".
/// Fails    UsageError for a lens that is no polynomial of x/z and y/z, or has a tilt.
std::vector<StudiedLens> lenses_for(const Camera& camera);
inline constexpr const char* lens_names[] = {"barrel", "pincushion", "decentred", "rational",
                                             "camera"};

}  // namespace fathom::studies
