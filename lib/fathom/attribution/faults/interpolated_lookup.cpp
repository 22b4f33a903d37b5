#include "fathom/attribution/faults/interpolated_lookup.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fathom/attribution/fragment.h"
#include "fathom/attribution/model/lens_samples.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double u = unit_roundoff<float>;

/// A pinhole's image around the image of the camera: so many more columns and rows in front of it.
struct Pinhole {
  Truth truth;
  std::uint32_t left = 0, above = 0;
};

/// Whole pixels by which points reach beyond an image of `size` pixels, in front of it and behind
/// it; at most the size of the image.
std::array<std::uint32_t, 2> beyond(double least, double greatest, std::uint32_t size) {
  const auto pixels = [&](double reach) {
    return static_cast<std::uint32_t>(std::clamp<double>(std::ceil(reach) + 2, 0, size));
  };
  return {pixels(-least), pixels(greatest - size)};
}

/// With the places of all samples, as far as an image of three times the size contains them.
Pinhole pinhole_around(const Truth& truth) {
  const std::uint32_t width = truth.camera.width, height = truth.camera.height;
  ImageBox box;
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      const auto& [x, y] = truth.lens->at(column, row);
      if (!std::isnan(x)) box.add(x, y, 0, 0);
    }
  }
  const auto [left, right] = beyond(box.least_x, box.greatest_x, width);
  const auto [above, below] = beyond(box.least_y, box.greatest_y, height);
  Camera camera = truth.camera;
  camera.width += left + right;
  camera.height += above + below;
  camera.projection.cx += left;
  camera.projection.cy += above;
  return {seen_by(truth, camera), left, above};
}

/// What a pinhole's map may hold at a pixel: nothing certain where both are NaN.
struct Held {
  double least = infinity, greatest = infinity;
  [[nodiscard]] bool is_background() const { return least == infinity; }
};

/// The depths that the model allows, pixel by pixel.
std::vector<Held> held_by(const Truth& pinhole, RendererModel model) {
  model.sample.lens = nullptr;
  OtherMap map{.width = pinhole.camera.width, .height = pinhole.camera.height};
  map.depths = pinhole.depths;
  const Attribution found = attribute(pinhole, map, model);
  std::vector<Held> held(map.depths.size());
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (!std::isfinite(pinhole.depths[i])) continue;
    const double least = found.least[i], greatest = found.greatest[i];
    const bool is_known = std::isfinite(least) && std::isfinite(greatest);
    // They are rounded to binary32.
    held[i] = is_known ? Held{least * (1 - 2 * u), greatest * (1 + 2 * u)} : Held{nan, nan};
  }
  return held;
}

/// How a program looks up.
struct Lookup {
  /// From the right place, in both directions: the two conventions of pixel centres, mixed up.
  double offset = 0;
  /// Places are rounded to 32nds of a pixel.
  bool in_32nds = false;
  /// The image that is looked up ends where the camera's does.
  bool ends = false;
};

/// A range of places along an axis, within one gap between pixel centres: weights of the second
/// pixel.
struct Piece {
  std::int64_t first;
  double from, to;
};

/// `place` counts from the centre of the first pixel. It is a sum with the principal point's
/// coordinate `centre`.
std::vector<Piece> pieces(double place, double centre, bool in_32nds) {
  // Roundings of the ray, of its product with the focal length, and of two sums.
  const double error = 8 * u * (std::abs(place) + std::abs(centre) + 1);
  double least = place - error, greatest = place + error;
  if (in_32nds) {
    least = std::nearbyint(32 * least) / 32;
    greatest = std::nearbyint(32 * greatest) / 32;
  }
  std::vector<Piece> list;
  for (double first = std::floor(least); first <= greatest; ++first)
    list.push_back({static_cast<std::int64_t>(first), std::max(least - first, 0.0),
                    std::min(greatest - first, 1.0)});
  return list;
}

/// The pinhole's map, looked up at the places of the camera's pixels.
class LookedUp {
 public:
  LookedUp(const Truth& truth, const OtherMap& other, const Pinhole& pinhole,
           const std::vector<Held>& held, const Lookup& lookup)
      : truth_(truth),
        other_(other),
        pinhole_(pinhole),
        held_(held),
        lookup_(lookup),
        centre_(principal_point(truth.camera.projection)) {
    for (std::size_t i = 0; i < other.values.size(); ++i)
      if (!std::isfinite(other.depths[i])) background_ = other.values[i];
  }

  /// Whether the value of a pixel may be looked up.
  [[nodiscard]] bool explains(std::uint32_t column, std::uint32_t row) const {
    const double value = other_.depths[std::size_t{row} * truth_.camera.width + column];
    const auto& [x, y] = truth_.lens->at(column, row);
    if (std::isnan(x)) return !std::isfinite(value);
    // Far away there is no image.
    if (std::max(std::abs(x), std::abs(y)) > 0x1p30) return !std::isfinite(value);
    for (const Piece& across : pieces(x - 0.5 + lookup_.offset, centre_.x, lookup_.in_32nds))
      for (const Piece& down : pieces(y - 0.5 + lookup_.offset, centre_.y, lookup_.in_32nds))
        if (is_mean(value, across, down)) return true;
    return false;
  }

 private:
  /// Of a pixel of the camera's image, or beyond it.
  [[nodiscard]] Held at(std::int64_t column, std::int64_t row) const {
    const Camera& image = lookup_.ends ? truth_.camera : pinhole_.truth.camera;
    const std::int64_t left = lookup_.ends ? 0 : pinhole_.left,
                       above = lookup_.ends ? 0 : pinhole_.above;
    Held held;
    if (column + left >= 0 && row + above >= 0 && column + left < image.width &&
        row + above < image.height)
      held = held_[static_cast<std::size_t>(row + pinhole_.above) * pinhole_.truth.camera.width +
                   static_cast<std::size_t>(column + pinhole_.left)];
    if (held.is_background() && std::isfinite(background_)) return {background_, background_};
    return held;
  }

  /// What a mean at a place may be, with weights x and y of the second column and row.
  struct Mean {
    double least = 0, greatest = 0;
    /// Of the depths.
    double size = 0;
    /// Whether a pixel has background that is not a number to compute with, at all and with a
    /// weight that is not 0.
    bool touches_background = false, has_background = false;
    bool is_known = true;
  };
  [[nodiscard]] Mean mean_at(std::int64_t column, double x, std::int64_t row, double y) const {
    const std::array weights{(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    Mean mean;
    for (std::size_t k = 0; k < 4; ++k) {
      const Held held =
          at(column + static_cast<std::int64_t>(k % 2), row + static_cast<std::int64_t>(k / 2));
      if (held.is_background()) {
        mean.touches_background = true;
        mean.has_background = mean.has_background || weights[k] > 0;
        continue;
      }
      mean.is_known = mean.is_known && !std::isnan(held.least);
      mean.least += weights[k] * held.least;
      mean.greatest += weights[k] * held.greatest;
      mean.size = std::max({mean.size, std::abs(held.least), std::abs(held.greatest)});
    }
    return mean;
  }

  /// Over a piece a mean is linear in either weight, so its extremes are at corners. Background
  /// with the weight 0 makes background in most programs, and nothing in others.
  [[nodiscard]] bool is_mean(double value, const Piece& across, const Piece& down) const {
    double least = infinity, greatest = -infinity, size = 0;
    bool may_be_background = false;
    for (const double x : {across.from, across.to}) {
      for (const double y : {down.from, down.to}) {
        const Mean mean = mean_at(across.first, x, down.first, y);
        if (!mean.is_known) return false;
        may_be_background = may_be_background || mean.touches_background;
        if (mean.has_background) continue;
        least = std::min(least, mean.least);
        greatest = std::max(greatest, mean.greatest);
        size = std::max(size, mean.size);
      }
    }
    if (!std::isfinite(value)) {
      if (may_be_background) return true;
      value = background_;
    }
    // Of three products of weights, four products and three sums in binary32, and room.
    const double roundings = 16 * u * size;
    return value >= least - roundings && value <= greatest + roundings;
  }

  const Truth& truth_;
  const OtherMap& other_;
  const Pinhole& pinhole_;
  const std::vector<Held>& held_;
  Lookup lookup_;
  /// As it is stored.
  double background_ = infinity;
  PrincipalPoint centre_;
};

std::string text_of(const Lookup& lookup, const Truth& truth) {
  const std::string_view lens = name_of(whole_camera(truth).projection.lens->model);
  std::string off;
  if (lookup.offset != 0)
    off = fmt::format(
        ", {:+g} pixels off in both directions (the centre of the first pixel is "
        "(0, 0) in one program and (0.5, 0.5) in another)",
        lookup.offset);
  return fmt::format(
      "the map of a pinhole camera was looked up bilinearly{}: its depths are means of up to four "
      "pixels, also across edges; draw along the rays of the lens {}, or look up the nearest pixel",
      off, lens);
}

/// The unexplained pixels whose values are looked up, as a finding. In a map that is looked up, the
/// other pixels have such values, too: nullopt if the pixels of the image without such a value are
/// more than a tenth of the unexplained.
std::optional<PixelFinding> explained_by(const LookedUp& map, const Lookup& lookup,
                                         const Truth& truth, const Attribution& found) {
  const std::uint64_t most = found.count(PixelClass::unexplained) / 10;
  std::uint64_t left = 0;
  PixelFinding some{{"remapped", text_of(lookup, truth)},
                    std::vector<std::uint8_t>(found.classes.size())};
  for (std::size_t i = 0; i < found.classes.size(); ++i) {
    const auto column = static_cast<std::uint32_t>(i % truth.camera.width),
               row = static_cast<std::uint32_t>(i / truth.camera.width);
    if (!map.explains(column, row)) {
      if (++left > most) return std::nullopt;
    } else if (found.classes[i] == PixelClass::unexplained) {
      some.explained[i] = 1;
      ++some.finding.pixels;
    }
  }
  return some;
}

}  // namespace

std::optional<PixelFinding> interpolated_lookup(const Truth& truth, const OtherMap& other,
                                                const RendererModel& model,
                                                const Attribution& found) {
  const Pinhole pinhole = pinhole_around(truth);
  const std::vector<Held> held = held_by(pinhole.truth, model);
  std::optional<PixelFinding> best;
  for (const double offset : {0.0, 0.5, -0.5}) {
    for (const bool in_32nds : {false, true}) {
      for (const bool ends : {true, false}) {
        const Lookup lookup{offset, in_32nds, ends};
        auto some = explained_by({truth, other, pinhole, held, lookup}, lookup, truth, found);
        if (some && (!best || some->finding.pixels > best->finding.pixels)) best = std::move(some);
      }
    }
  }
  return best;
}

}  // namespace fathom::attribution
