#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "apps/study/lens/lens_scene.h"
#include "fathom/camera/direction_table.h"
#include "fathom/image/depth_map.h"
#include "fathom/lens/iterated_inverses.h"

/// Maps of a scene through a lens: the exact one, and those of methods that approximate the lens.
/// All are drawn by the exact engine, so that they differ by the method alone.
namespace fathom::studies {

using lens::PlanePoint;

/// What a map shows at each pixel, row by row.
struct ShownMap {
  /// (x/z, y/z) of the point that is seen; NaN where there is none, or a mean of several points.
  std::vector<PlanePoint> rays;
  /// Numbers in LensScene::surfaces; no_surface, mixed_surfaces.
  std::vector<std::uint32_t> surfaces;
  /// In binary64, of the visible triangle's plane; +∞ without a surface.
  std::vector<double> depths;
};
/// The depth is a mean over several surfaces.
inline constexpr std::uint32_t mixed_surfaces = no_surface - 1;

/// A scene through a lens that is no pinhole.
class LensView {
 public:
  LensView(const LensScene& scene, const Lens& lens);

  [[nodiscard]] const LensScene& scene() const { return scene_; }
  [[nodiscard]] const Camera& camera() const { return camera_; }
  [[nodiscard]] const lens::StageNumbers<double>& stage() const { return stage_; }
  /// y of the centre of each pixel, for an inverse.
  [[nodiscard]] PlanePoint distorted_point(std::size_t pixel) const;
  /// The exact directions, each number rounded once, and what they show.
  [[nodiscard]] const ShownMap& exact() const { return exact_; }
  /// Where the lens shows a ray, in pixels, by binary64; nullopt beyond the end of the lens.
  [[nodiscard]] std::optional<std::array<double, 2>> place_of(const PlanePoint& ray) const;

 private:
  const LensScene& scene_;
  Camera camera_;
  lens::StageNumbers<double> stage_;
  double end_;  ///< the greatest |m|²
  ShownMap exact_;
};

/// The rays of an inverse in place of the exact ones. It returns nullopt where it finds no ray.
using Inverse = std::function<std::optional<PlanePoint>(const lens::StageNumbers<double>& stage,
                                                        const PlanePoint& y)>;
ShownMap map_by_inverse(const LensView& view, const Inverse& inverse);

/// The map of a pinhole, looked up at the places of the exact rays: at the nearest pixel, or as the
/// mean of four pixels, which has no ray of its own. It is three times as wide and as high as the
/// image, so that it contains rays that the lens pulls into the image.
enum class Lookup { nearest, bilinear };
ShownMap map_by_lookup(const LensView& view, Lookup lookup);

/// The scene with its triangles in n² pieces each, edges in n parts, and the corners of these moved
/// in the plane of their depth to where a pinhole shows them as the lens does. A piece with a
/// corner that lies behind the camera or beyond the end of the lens covers nothing.
struct BentMesh {
  int parts;
  Scene bent;
  /// The corners of `bent` before they were moved.
  std::vector<MeshPoint> points;
};
BentMesh bend_vertices(const LensView& view, int parts);

struct BentMap {
  ShownMap shown;
  /// Of the visible pieces, in pixels.
  double longest_edge;
};
BentMap map_by_vertices(const LensView& view, const BentMesh& mesh);

/// How a map differs from the exact one.
struct LensErrors {
  /// Pixels that have a ray or show a surface in the exact map.
  std::uint64_t rays = 0, surface_pixels = 0;
  /// From a pixel's centre to where the lens shows the point that the map has there, in pixels;
  /// over pixels with a ray in both maps; nullopt if there is no such pixel.
  std::optional<double> greatest, mean;
  /// Pixels with a ray in both maps whose ray the lens shows nowhere; with a ray here alone.
  std::uint64_t beyond = 0, invented_rays = 0;
  /// Pixels that show another surface, none, or one where there is none.
  std::uint64_t other_surface = 0, missing = 0, invented = 0;
  /// |D − exact|/exact, where both show the same surface.
  double greatest_depth = 0;

  [[nodiscard]] std::uint64_t wrong_surface() const { return other_surface + missing + invented; }
};
LensErrors errors_of(const ShownMap& shown, const LensView& view);

/// The errors pixel by pixel, for pictures: channels Z, `pixels` and `depth`, in binary32; +∞ where
/// there is nothing to compare.
DepthMap error_map(const ShownMap& shown, const LensView& view);

}  // namespace fathom::studies
