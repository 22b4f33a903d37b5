#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"
#include "fathom/geometry/frames.h"
#include "fathom/numeric/interval.h"

namespace fathom::attribution {

/// Whether a renderer of the model covers a sample with a triangle, whatever its roundings are.
enum class Coverage : std::uint8_t { must_not, may, must };

/// In Fragment::open_edges: it is unknown which edges are open.
inline constexpr std::uint8_t joins_no_other = 0x80;

/// A triangle at a sample, as a renderer of the model may draw it.
struct Fragment {
  std::uint32_t triangle = 0;
  Coverage coverage = Coverage::must_not;
  /// The edges whose side the model leaves open: bit k is the edge opposite corner k. `inside`:
  /// whether the sample is inside the exact corners. Edges are directed so that the inside is on
  /// their left.
  std::uint8_t open_edges = 0;
  bool turned = false;  ///< the corners run the other way round in the image
  bool inside = false;
  /// All values that may be stored for the triangle here. Window depths (raster) or depths (ray);
  /// smaller is always nearer, because reversed window depths are negated.
  Interval value;
  /// The stored value without any rounding.
  double exact = 0;
};

/// A growing box of the image plane, in pixels from the top left.
struct ImageBox {
  double least_x = std::numeric_limits<double>::infinity(), least_y = least_x;
  double greatest_x = -least_x, greatest_y = -least_x;

  /// Extends the box to a point and its surroundings up to `margin_x`, `margin_y` from it.
  void add(double x, double y, double margin_x, double margin_y);
};

/// All pixels of an image.
PixelBox whole_image(const Camera& camera);

/// An image in squares of pixels, numbered row by row: what holds for all samples of a square is
/// computed once.
class PixelSquares {
 public:
  explicit PixelSquares(const Camera& camera) : width_(camera.width), height_(camera.height) {}

  [[nodiscard]] std::size_t count() const {
    return std::size_t{squares(width_)} * squares(height_);
  }
  /// The square of a pixel.
  [[nodiscard]] std::size_t of(std::uint32_t column, std::uint32_t row) const {
    return std::size_t{row / side} * squares(width_) + column / side;
  }
  [[nodiscard]] PixelBox pixels(std::size_t square) const;
  /// The smallest box of pixels around the squares for which `is_met(square)`.
  template <class IsMet>
  [[nodiscard]] PixelBox around(const IsMet& is_met) const {
    PixelBox all;
    for (std::size_t square = 0; square < count(); ++square)
      if (is_met(square)) extend(all, pixels(square));
    return all;
  }

 private:
  static constexpr std::uint32_t side = 16;
  static constexpr std::uint32_t squares(std::uint32_t pixels) {
    return (pixels + side - 1) / side;
  }
  static void extend(PixelBox& box, const PixelBox& more);

  std::uint32_t width_, height_;
};

/// The pixels that a box meets, enlarged by `more` pixels on each side; empty if it misses the
/// image.
PixelBox pixels_of(const ImageBox& box, const Camera& camera, double more);

/// Column and row of a pixel, from the top left, and a fragment there.
using TakeFragment =
    std::function<void(std::uint32_t column, std::uint32_t row, const Fragment& fragment)>;

/// The triangles of a mesh as a renderer of a model draws them. Several threads may call it at
/// once.
class FragmentSource {
 public:
  FragmentSource() = default;
  virtual ~FragmentSource() = default;
  FragmentSource(const FragmentSource&) = delete;
  FragmentSource& operator=(const FragmentSource&) = delete;

  /// Pixels outside which the triangle is never covered.
  [[nodiscard]] virtual PixelBox box(std::uint32_t triangle) const = 0;
  /// Calls `take(column, row, fragment)` for the pixels of `box` whose sample the triangle covers
  /// or may cover.
  virtual void each(std::uint32_t triangle, const PixelBox& box,
                    const TakeFragment& take) const = 0;
};

/// `camera` has finite near and far where a raster model has such a mapping; the mesh outlives the
/// source.
std::unique_ptr<FragmentSource> fragments(const WorldMesh& mesh, const Camera& camera,
                                          const RendererModel& model);
std::unique_ptr<FragmentSource> raster_fragments(const WorldMesh& mesh, const Camera& camera,
                                                 const SamplePosition& sample,
                                                 const RasterModel& model);
std::unique_ptr<FragmentSource> ray_fragments(const WorldMesh& mesh, const Camera& camera,
                                              const SamplePosition& sample, const RayModel& model);

}  // namespace fathom::attribution
