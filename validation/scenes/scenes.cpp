#include "validation/scenes/scenes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "fathom/camera/camera_making.h"
#include "fathom/failures/errors.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "validation/scenes/made/made_meshes.h"
#include "validation/scenes/shapes.h"

namespace fathom::bench {
namespace {

const std::vector<std::string> made_names{"mesh",         "soup", "few-large",    "grid-aligned",
                                          "grid-shifted", "room", "room-outside", "scan",
                                          "city",         "tree", "text",         "cad"};

/// The N of "city-N".
std::optional<std::uint32_t> city_blocks(const std::string& name) {
  if (!name.starts_with("city-")) return std::nullopt;
  const char* const end = name.data() + name.size();
  std::uint32_t blocks = 0;
  const auto [rest, error] = std::from_chars(name.data() + 5, end, blocks);
  if (error != std::errc() || rest != end || blocks < 1 || blocks > 1000) return std::nullopt;
  return blocks;
}

/// The N of "sphere-N": a number, which may end in k or m.
std::optional<std::uint64_t> sphere_size(const std::string& name) {
  if (!name.starts_with("sphere-")) return std::nullopt;
  const char* const end = name.data() + name.size();
  std::uint64_t number = 0;
  const auto [rest, error] = std::from_chars(name.data() + 7, end, number);
  const std::string suffix(rest, end);
  if (suffix == "k") number *= 1000;
  if (suffix == "m") number *= 1'000'000;
  const bool known = suffix.empty() || suffix == "k" || suffix == "m";
  if (error != std::errc() || !known || number < 8 || number > 3'000'000'000) return std::nullopt;
  return number;
}

/// The sphere's outline has the radius focal / √(3² − 1): 523.5 pixels of 1080.
Camera sphere_camera(const ImageSize& size) {
  const double radius = 523.5 / 1080 * size.least();
  return look_from({.azimuth = 35, .elevation = 25}, {0, 0, 0}, 3,
                   {.width = size.width, .height = size.height, .focal = radius * std::sqrt(8.0)});
}

/// One unit of the world is one pixel.
BenchScene grid_scene(const std::string& name, const ImageSize& size) {
  Camera camera{.width = size.width,
                .height = size.height,
                .projection = {.model = ProjectionModel::orthographic}};
  const std::uint32_t step = std::max(1U, size.least() / 1000);
  const std::uint32_t columns = std::min(1000U, size.width / step);
  const std::uint32_t rows = std::min(1000U, size.height / step);
  const bool shifted = name == "grid-shifted";
  // Whole pixels, so that corners lie on pixel centres.
  const std::uint32_t margin_left = (size.width - columns * step) / 2;
  const std::uint32_t margin_top = (size.height - rows * step) / 2;
  const double left = margin_left + 0.5 + (shifted ? 0.1234567 : 0);
  const double top = margin_top + 0.5 + (shifted ? 0.7654321 : 0);
  return {name, as_scene({grid(columns, rows, left, top, step)}, name), camera};
}

BenchScene room_scene(const std::string& name, const ImageSize& size) {
  const LensChoice lens{.width = size.width, .height = size.height, .vertical_fov = 60};
  const Camera camera = name == "room"
                            ? look_at({-2.9, 0.4, 2.3}, {1.5, -0.5, -1.2}, {0, 1, 0}, lens)
                            : look_at({-7, 2.5, 8}, {0, 0, 0}, {0, 1, 0}, lens);
  return {name, as_scene(room(100), name), camera};
}

/// The boulder from 3.5 away: its outline reaches nine tenths of the way to the image's border.
BenchScene scan_scene(const ImageSize& size) {
  const double focal = 0.485 * std::sqrt(8.0) * size.least();
  const Camera camera = look_from({.azimuth = 35, .elevation = 25}, {0, 0, 0}, 3.5,
                                  {.width = size.width, .height = size.height, .focal = focal});
  return {"scan", as_scene({scan(1'030'000)}, "scan"), camera};
}

/// From the middle of a street, between two rows of houses, along it.
Camera street_camera(const ImageSize& size) {
  const double z = -street_spacing / 2;
  return look_at({1.5, 1.7, z}, {-1, 6, z + 50}, {0, 1, 0},
                 {.width = size.width, .height = size.height, .vertical_fov = 60});
}

/// The page from below, so that the last line is larger than the first.
Camera page_camera(const ImageSize& size, double height) {
  return look_at({page_width / 2, -1.0 * height, 38}, {page_width / 2, -0.62 * height, 0},
                 {0, 1, 0}, {.width = size.width, .height = size.height, .vertical_fov = 52});
}

BenchScene city_scene(const std::string& name, std::uint32_t blocks, const ImageSize& size) {
  return {name, as_scene({city(blocks)}, name), street_camera(size)};
}

BenchScene tree_scene(const ImageSize& size) {
  return {"tree", as_scene({tree(6, 150)}, "tree"),
          look_at({16, 1.7, 17}, {0, 8.5, 0}, {0, 1, 0},
                  {.width = size.width, .height = size.height, .vertical_fov = 45})};
}

BenchScene text_scene(const ImageSize& size) {
  constexpr std::uint32_t lines = 60;
  return {"text", as_scene({text_page(lines)}, "text"), page_camera(size, page_height(lines))};
}

BenchScene cad_scene(const ImageSize& size) {
  return {"cad", as_scene({machine_part(24)}, "cad"),
          look_at({8, -27, 29}, {0.3, -1.5, 0}, {0, 0, 1},
                  {.width = size.width, .height = size.height, .vertical_fov = 40})};
}

Scene read(const std::string& file) {
  Warnings warnings;
  return read_scene({file}, {.hash = false}, warnings);
}

BenchScene framed(const std::string& name, Scene scene, const ImageSize& size) {
  const Camera camera = frame_scene(scene, {}, {.width = size.width, .height = size.height});
  return {name, std::move(scene), camera};
}

}  // namespace

std::vector<std::string> default_scene_names() {
  return {"sphere-20k",   "sphere-200k", "sphere-2m", "mesh", "soup", "few-large", "grid-aligned",
          "grid-shifted", "room",        "scan",      "city", "tree", "text",      "cad"};
}

bool is_made_scene(const std::string& name) {
  return sphere_size(name) || city_blocks(name) ||
         std::find(made_names.begin(), made_names.end(), name) != made_names.end();
}

BenchScene make_scene(const std::string& name, std::uint32_t width, std::uint32_t height) {
  const ImageSize size{width, height};
  if (const auto triangles = sphere_size(name)) {
    return {name, as_scene({sphere(*triangles)}, name), sphere_camera(size)};
  }
  if (name == "mesh") return framed(name, read(FATHOM_DATA_DIR "/meshes/teapot.obj"), size);
  if (name == "soup" || name == "few-large") {
    const Camera camera = simple_camera(size);
    Mesh mesh = name == "soup" ? soup(100'000, 50, camera) : few_large(12, camera);
    return {name, as_scene({std::move(mesh)}, name), camera};
  }
  if (name.starts_with("grid-") && is_made_scene(name)) return grid_scene(name, size);
  if (name.starts_with("room") && is_made_scene(name)) return room_scene(name, size);
  if (name == "scan") return scan_scene(size);
  if (name == "city") return city_scene(name, 20, size);
  if (const auto blocks = city_blocks(name)) return city_scene(name, *blocks, size);
  if (name == "tree") return tree_scene(size);
  if (name == "text") return text_scene(size);
  if (name == "cad") return cad_scene(size);
  return framed(name, read(name), size);
}

}  // namespace fathom::bench
