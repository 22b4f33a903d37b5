#include "fathom/area/scene_surfaces.h"

#include <algorithm>

#include "fathom/area/equal_triangles.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

namespace fathom::area {
using namespace triangle;

namespace {

bool meet(const PixelBox& a, const PixelBox& b) {
  return a.first_column <= b.last_column && b.first_column <= a.last_column &&
         a.first_row <= b.last_row && b.first_row <= a.last_row;
}

}  // namespace

SurfaceParts::~SurfaceParts() {
  // Work that has been interrupted leaves no sooner than its memory is free.
  const Interruptible never(nullptr);
  try {
    in_parallel(parts_.size(), [&](std::size_t part) { Part().swap(parts_[part]); });
  } catch (...) {
    // Without memory for threads: the members free what is left.
  }
}

std::uint64_t SceneSurfaces::parts(std::uint32_t triangles) {
  return triangles / SurfaceParts::triangles_per_part + 1;
}

SceneSurfaces::SceneSurfaces(const CoverageFrame& frame, Progress& progress)
    : columns_((frame.camera.width - 1) / side_of_tile + 1),
      boxes_(frame.triangles.count()),
      surfaces_(frame.triangles.count()),
      tiles_(std::size_t{columns_} * ((frame.camera.height - 1) / side_of_tile + 1)),
      first_(count()),
      first_of_object_(count()) {
  parallel_for(std::uint32_t{0}, surfaces_.size(), [&](std::uint32_t part) {
    surfaces_.make(part, [&](std::uint32_t number) { return surface_of(frame, number); });
    progress.part_done();
  });
  find_equal_triangles(frame.triangles);
  for (std::uint32_t number = 0; number < count(); ++number) {
    check_interruption();
    if (surfaces_[number] == nullptr) continue;
    const PixelBox& box = boxes_[number];
    for (std::uint32_t y = box.first_row / side_of_tile; y <= box.last_row / side_of_tile; ++y) {
      for (std::uint32_t x = box.first_column / side_of_tile; x <= box.last_column / side_of_tile;
           ++x) {
        tiles_[std::size_t{y} * columns_ + x].push_back(number);
      }
    }
  }
}

std::optional<SurfaceRegion> SceneSurfaces::surface_of(const CoverageFrame& frame,
                                                       std::uint32_t number) {
  TierCounts counts;
  const ProjectedTriangle t =
      project(frame.triangles.world_corners(number), number, frame.camera, counts);
  if (t.orientation == Sign::zero || !is_kept(t, frame.cull)) return std::nullopt;
  boxes_[number] = bounding_box(t, frame.camera);
  if (boxes_[number].is_empty()) return std::nullopt;
  return surface_region(t, frame.camera);
}

void SceneSurfaces::find_equal_triangles(const TriangleSource& triangles) {
  EqualTriangles in_scene(triangles);
  std::optional<EqualTriangles> in_object;
  std::optional<std::uint32_t> object;
  for (std::uint32_t number = 0; number < count(); ++number) {
    check_interruption();
    if (surfaces_[number] == nullptr) continue;
    if (const std::uint32_t its = triangles.origin(number).object; its != object) {
      in_object.emplace(triangles);
      object = its;
    }
    first_[number] = in_scene.is_first(number);
    first_of_object_[number] = in_object->is_first(number);
  }
}

// Boxes that meet have a first tile in common, in which the other one is taken.
template <class Take>
void SceneSurfaces::for_each_near(std::uint32_t number, const Take& take) const {
  const PixelBox& box = boxes_[number];
  for (std::uint32_t y = box.first_row / side_of_tile; y <= box.last_row / side_of_tile; ++y) {
    for (std::uint32_t x = box.first_column / side_of_tile; x <= box.last_column / side_of_tile;
         ++x) {
      for (const std::uint32_t other : tiles_[std::size_t{y} * columns_ + x]) {
        const PixelBox& its = boxes_[other];
        if (other == number || !meet(box, its)) continue;
        const bool is_first = std::max(box.first_column, its.first_column) / side_of_tile == x &&
                              std::max(box.first_row, its.first_row) / side_of_tile == y;
        if (is_first) take(other);
      }
    }
  }
}

std::vector<std::uint32_t> SceneSurfaces::near(std::uint32_t number) const {
  std::vector<std::uint32_t> found;
  for_each_near(number, [&](std::uint32_t other) { found.push_back(other); });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::uint32_t> SceneSurfaces::in_front(std::uint32_t number) const {
  const double farthest = surfaces_[number]->depths.upper;
  std::vector<std::uint32_t> found;
  for_each_near(number, [&](std::uint32_t other) {
    if (surfaces_[other]->depths.lower <= farthest) found.push_back(other);
  });
  std::sort(found.begin(), found.end(), [&](std::uint32_t a, std::uint32_t b) {
    return is_nearer(*surfaces_[a], *surfaces_[b]);
  });
  return found;
}

}  // namespace fathom::area
