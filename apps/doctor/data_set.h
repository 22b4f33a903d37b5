#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "apps/doctor/hypothesis.h"
#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/scene/scene.h"

/// Depth images with their cameras, compared with exact depths at a grid of their pixels.
namespace fathom::doctor {

/// A depth image as it is stored, without any correction.
struct DepthImage {
  std::string file;
  ImageSize size;
  /// Depths in the unit of the file, row by row from the top; infinite where there is no value.
  std::vector<double> depths;
  /// Codes per unit, of an image of integers.
  std::optional<double> code_scale;
  /// Pixels with the stored number 0, and whether all pixels without a value have it.
  std::uint64_t zeros = 0;
  bool is_zero_none = false;

  /// The distance of two codes; 0 of floating-point numbers.
  [[nodiscard]] double step() const { return code_scale ? 1 / *code_scale : 0; }
  /// The depth at a column and row; nullopt outside the image.
  [[nodiscard]] std::optional<double> at(const std::array<std::int64_t, 2>& place) const;
};

/// The depths of a map. `png_scale`: the codes per unit if the map holds integers.
/// Fails    InputError if the map has no channel of depths.
DepthImage depth_image(DepthMap map, const std::string& file, double png_scale);

struct View {
  Camera camera;
  DepthImage image;
};

/// Fails    InputError if no pixel of the views has a depth.
void require_depths(const std::vector<View>& views);

/// A stored number that many pixels have, and that is the greatest: depths were clipped there, or
/// it stands for no value.
struct Ceiling {
  double depth = 0;
  /// Of the pixels with a value, in the images that were looked at.
  std::uint64_t pixels = 0;
};

/// The ceiling of images, if they have one: the code 65535, or a greatest number that at least one
/// in 200 pixels has, but not nearly all.
std::optional<Ceiling> ceiling_of(const std::vector<View>& views);

/// What to do with pixels at the ceiling.
enum class CeilingPixels : std::uint8_t {
  left_out,
  alone,      ///< all other pixels are left out
  as_stored,  ///< they have the depth of the ceiling
  as_none     ///< they have no value
};

/// A pixel of a grid: the stored depth and the exact one; infinite where there is none.
struct Pair {
  float stored = 0, exact = 0;
  /// The distance of two codes.
  float step = 0;
  /// Pixels of the same block lie together in the same image.
  std::uint32_t block = 0;
};

/// The exact depths of a camera at a grid of its pixels.
struct Grid {
  Camera camera;
  std::uint32_t stride = 1, first = 0, width = 0, height = 0;
  std::vector<float> depths, distances;
};

class DataSet {
 public:
  DataSet(const Scene& scene, std::vector<View> views, int threads);

  [[nodiscard]] const std::vector<View>& views() const { return views_; }
  [[nodiscard]] const std::optional<Ceiling>& ceiling() const { return ceiling_; }
  /// Whether an image has another size than its camera.
  [[nodiscard]] bool has_other_sizes() const;
  /// Whether images and cameras are upright in one and lying in the other.
  [[nodiscard]] bool has_turned_sizes() const;

  /// Exact depths of the first `images` images, at about `pixels` pixels of each; valid until the
  /// next call. Hypotheses with the same rendering_of() are rendered once.
  const std::vector<Grid>& grids(const Hypothesis& hypothesis, std::size_t images,
                                 std::size_t pixels);
  /// The pixels of grids of cameras with the same poses, units, lenses and sizes. Depths are as
  /// they are stored, except for truncated codes, which get half a code.
  [[nodiscard]] std::vector<Pair> pairs(const std::vector<Grid>& grids,
                                        const Hypothesis& hypothesis,
                                        CeilingPixels of_ceiling = CeilingPixels::left_out) const;

 private:
  /// What was rendered, the latest first.
  struct Rendering {
    Hypothesis hypothesis;
    std::size_t images, pixels;
    std::vector<Grid> grids;
  };

  [[nodiscard]] std::vector<Grid> rendered(const Hypothesis& hypothesis, std::size_t images,
                                           std::size_t pixels) const;

  const Scene* scene_;
  std::vector<View> views_;
  std::list<Rendering> renderings_;
  std::optional<Ceiling> ceiling_;
  int threads_;
};

/// How well a hypothesis explains pixels.
struct Agreement {
  /// Pixels with a stored depth, and the share of them whose exact depth is near.
  std::uint64_t pixels = 0;
  double share = 0;
  /// The share of all pixels where both or neither have a depth.
  double silhouettes = 0;
  /// Pixels where both have a depth, and their residuals in scene units.
  std::uint64_t compared = 0;
  double median = 0, largest = 0;
};

/// Differences that count as near: a part of the depth, a part of the range of depths, and half a
/// code.
struct Tolerance {
  double of_depth = 0.02, of_range = 0.1;
};

/// `depth_scale`: the stored depths of a scene unit.
Agreement agreement(const std::vector<Pair>& pairs, double depth_scale, const Tolerance& tolerance);

/// The median of stored by exact depths; 1 if no pixel has both.
double median_ratio(const std::vector<Pair>& pairs);

/// The median of the relative residuals.
double median_relative(const std::vector<Pair>& pairs, double depth_scale);

}  // namespace fathom::doctor
