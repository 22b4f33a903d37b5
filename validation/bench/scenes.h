#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

/// What is timed: a scene and the camera that looks at it.
///
///   sphere-20k, sphere-200k, sphere-2m
///                  a sphere seen whole: 0.415 of the pixels of a 16:9 image are covered (861
///                  thousand at 1920×1080). sphere-N is made for any N ("sphere-5000", "sphere-7k")
///   mesh           the largest mesh of data/: the Utah teapot of 6320 triangles
///   soup           100 thousand random triangles, about 50 over each pixel
///   few-large      12 triangles, each covering the whole image and more
///   grid-aligned   a million quads (fewer in an image of less than a million pixels) under an
///                  orthographic camera; every corner lies on a pixel centre, so that every edge
///                  runs through pixel centres
///   grid-shifted   the same, shifted by (0.1234567, 0.7654321) pixel
///   room           a closed room of 120 thousand triangles, seen from inside
///   room-outside   the same, seen from outside
///
/// Any other name is a mesh or scene file, seen by the camera that frames it.
namespace fathom::bench {

struct BenchScene {
  std::string name;
  Scene scene;
  Camera camera;
};

/// The names that are timed where none are given: those above but room-outside, which is there to
/// be held against room.
std::vector<std::string> default_scene_names();

/// Whether a scene is made under this name, rather than read from a file.
bool is_made_scene(const std::string& name);

/// Makes or reads a scene for an image of width × height pixels.
/// Fails    InputError where the name is none of the above and no file that can be read.
BenchScene make_scene(const std::string& name, std::uint32_t width, std::uint32_t height);

}  // namespace fathom::bench
