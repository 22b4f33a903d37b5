#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/geometry/frames.h"
#include "fathom/lens/preimages.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::reference {

/// Where in an image of bent rays a triangle may be seen: boxes around the directions of groups of
/// samples, 4 × 4 pixels each, and around four groups at a time up to the whole image. They save
/// time and decide nothing: a triangle that they leave out covers no sample of the group.
class RayGroups {
 public:
  static constexpr std::uint32_t pixels = 4;

  /// `chosen` pixels are looked at, row by row; nullptr: all of them.
  RayGroups(const lens::Preimages& preimages, std::uint32_t width, std::uint32_t height,
            const std::vector<bool>* chosen);

  /// A box that contains every chosen pixel whose sample the triangle covers; empty if there is no
  /// such pixel.
  [[nodiscard]] PixelBox box_of(const triangle::ProjectedTriangle& t) const;

 private:
  /// Around the directions of some samples, none of which need have a ray.
  struct Directions {
    std::array<Interval, 3> box{};
    bool is_empty = true;

    void add(const Directions& other);
    [[nodiscard]] bool may_meet(const triangle::ProjectedTriangle& t) const;
  };
  /// The groups of one level, row by row.
  struct Level {
    std::uint32_t columns = 0, rows = 0;
    std::vector<Directions> groups;
  };

  [[nodiscard]] Directions around(const lens::Preimages& preimages, const PixelBox& area,
                                  const std::vector<bool>* chosen) const;
  void add_levels();
  void extend(PixelBox& box, const triangle::ProjectedTriangle& t, std::size_t level,
              std::uint32_t column, std::uint32_t row) const;

  std::uint32_t width_, height_;
  /// From single groups to a group that is the whole image.
  std::vector<Level> levels_;
};

/// How the samples of an image see: by straight edges, or along rays that a lens bends.
struct View {
  /// `chosen` pixels of the image are looked at, row by row; nullptr: all of them. Both must
  /// outlive the view.
  explicit View(const Camera& the_camera, const std::vector<bool>* chosen = nullptr)
      : camera(the_camera) {
    if (!bends_rays(camera.projection)) return;
    preimages.emplace(camera.projection, *camera.projection.lens);
    groups.emplace(*preimages, camera.width, camera.height, chosen);
  }

  /// A box that contains every pixel looked at whose sample the triangle covers.
  [[nodiscard]] PixelBox box_of(const triangle::ProjectedTriangle& t) const {
    return groups ? groups->box_of(t) : bounding_box(t, camera);
  }

  const Camera& camera;
  /// Where the camera bends rays.
  std::optional<lens::Preimages> preimages;
  std::optional<RayGroups> groups;
};

}  // namespace fathom::reference
