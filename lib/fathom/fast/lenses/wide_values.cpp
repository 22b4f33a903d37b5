#include "fathom/fast/lenses/wide_values.h"

#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/fused_multiply_add.h"
#include "fathom/triangle/settled_storage.h"

namespace fathom::fast {
using namespace triangle;

namespace {

/// What is known of a pixel: its surface in the window, and its ray.
struct Seen {
  const DepthForms<WordPair>& forms;
  /// D, if it is the same number at all corners.
  const std::optional<WordPair>& constant;
  const lens::DirectionWords& direction;
  const Projection& window;
  const ImageBounds& image;
  const ViewAxes& axes;
};

template <bool fused>
class ValuesAtPixel {
 public:
  using Real = DoubleWord<fused>;
  using Word = Certified<Real>;

  explicit ValuesAtPixel(const Seen& seen)
      : seen_(seen),
        x_(place(seen.axes.right)),
        y_(place(seen.axes.down)),
        depth_(window_depth()) {}

  [[nodiscard]] bool write(std::size_t pixel, const rendering::ChannelValues& values) const {
    if (double* const distances = values.distance.binary64) {
      const Word length = sqrt(x_ * x_ + y_ * y_ + Word{1.0, 0});
      const Word distance = depth_ * length;
      if (!take(to_binary64(distance.value, distance.error), distances[pixel])) return false;
    }
    if (values.depth.binary64 == nullptr && values.low == nullptr) return true;
    const Word depth = camera_depth();
    if (values.low && !store_low_part({depth.value, depth.error}, values.low[pixel])) return false;
    return values.depth.binary64 == nullptr ||
           take(to_binary64(depth.value, depth.error), values.depth.binary64[pixel]);
  }

 private:
  [[nodiscard]] Word along(const ViewAxes::Axis& axis) const {
    const Word component = in_words<fused>(seen_.direction[axis.of_camera]);
    return axis.sign > 0 ? component : -component;
  }
  [[nodiscard]] Word place(const ViewAxes::Axis& axis) const {
    return along(axis) / along(seen_.axes.forward);
  }

  // u = fx·x + cx, exactly. Bounds of forms hold in the image only.
  [[nodiscard]] Word window_depth() const {
    if (seen_.constant) return {*seen_.constant, 0};
    const Word u = x_ * Word{seen_.window.fx, 0} + Word{seen_.window.cx, 0};
    const Word v = y_ * Word{seen_.window.fy, 0} + Word{seen_.window.cy, 0};
    const auto is_within = [](const Word& coordinate, double greatest) {
      const double at = coordinate.value.hi;
      return at - coordinate.error >= 0 && at + coordinate.error <= greatest;
    };
    if (!is_within(u, seen_.image.u) || !is_within(v, seen_.image.v)) return {};
    const auto& [a, b, c, error] = seen_.forms.varying;
    const Form<Real> varying{a, b, c, error};
    return quotient(in_words<fused>(seen_.forms.constant), varying.at(u, v));
  }

  /// Z, along the z axis of the camera.
  [[nodiscard]] Word camera_depth() const {
    const auto& [right, down, forward] = seen_.axes;
    constexpr std::size_t z = 2;
    const double sign = right.of_camera == z  ? right.sign
                        : down.of_camera == z ? down.sign
                                              : forward.sign;
    const Word size = right.of_camera == z  ? depth_ * x_
                      : down.of_camera == z ? depth_ * y_
                                            : depth_;
    return sign > 0 ? size : -size;
  }

  const Seen& seen_;
  Word x_, y_;
  /// D in the window.
  Word depth_;
};

FATHOM_WITH_FMA bool write_with_fma(const Seen& seen, std::size_t pixel,
                                    const rendering::ChannelValues& values) {
  return ValuesAtPixel<true>(seen).write(pixel, values);
}

}  // namespace

void WideValues::start(std::size_t end_of_places) {
  surfaces_.clear();
  surfaces_.resize(end_of_places);
}

bool WideValues::write(std::size_t pixel, std::size_t place, std::uint32_t triangle,
                       const lens::DirectionWords& direction,
                       const rendering::ChannelValues& values) {
  static const bool fused = processor_has_fma();
  std::optional<SurfaceFacts>& facts = surfaces_[place];
  if (!facts) facts = surface_facts(triangle, frame_);
  if (!facts->usable) return false;
  const Seen seen{depth_of(*facts, frame_), constant_of(*facts, 3), direction,
                  window_.projection,       frame_.image,           axes_};
  return fused ? write_with_fma(seen, pixel, values)
               : ValuesAtPixel<false>(seen).write(pixel, values);
}

}  // namespace fathom::fast
