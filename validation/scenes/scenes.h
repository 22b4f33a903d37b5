#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

/// Scenes for timing, each with a camera.
///
///   sphere-20k, sphere-200k, sphere-2m
///                  a whole sphere, which covers 41.5 % of the pixels of a 16:9 image (861 thousand
///                  at 1920×1080). sphere-N is made for any N ("sphere-5000", "sphere-7k")
///   mesh           the largest mesh of data/: the Utah teapot of 6320 triangles
///   soup           100 thousand random triangles, about 50 over each pixel
///   few-large      12 triangles, each of which covers more than the whole image
///   grid-aligned   a million quads (fewer in an image of less than a million pixels) under an
///                  orthographic camera; every corner lies on a pixel centre, so every edge passes
///                  through pixel centres
///   grid-shifted   grid-aligned, shifted by (0.1234567, 0.7654321) pixel
///   room           a closed room of 120 thousand triangles, seen from inside
///   room-outside   the same room, seen from outside
///   scan           a bumpy boulder of 980 thousand triangles as a scanner leaves it: of uneven
///                  sizes, about a pixel, with noise and holes
///   city           309 thousand triangles of 400 houses, seen from the middle of a street: long
///                  and thin, from behind the camera to the horizon, most of them hidden. city-N
///                  has N × N houses ("city-2")
///   tree           a tree of 1.3 million triangles, most of them leaves below a pixel
///   text           a page of 500 thousand triangles that letters are cut into: slivers of a pixel
///                  and less in width
///   cad            a machine part of 412 thousand triangles as CAD programs make them: fans,
///                  strips and slivers around 864 holes, along rods and fillets
///
/// Any other name is a mesh or scene file, seen by the camera that frames it.
namespace fathom::bench {

struct BenchScene {
  std::string name;
  Scene scene;
  Camera camera;
};

/// The scenes that are timed by default: all above except room-outside, which exists for comparison
/// with room.
std::vector<std::string> default_scene_names();

/// Whether the scene of this name is generated rather than read from a file.
bool is_made_scene(const std::string& name);

/// Makes or reads a scene for an image of width × height pixels.
/// Fails    InputError if the name is not in the list above and not a readable file.
BenchScene make_scene(const std::string& name, std::uint32_t width, std::uint32_t height);

}  // namespace fathom::bench
