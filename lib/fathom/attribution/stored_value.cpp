#include "fathom/attribution/stored_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/attribution/attribution.h"

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The distance of neighbouring binary32 numbers about x.
double spacing(double x) {
  if (x == 0 || !std::isfinite(x)) return 0x1p-149;
  return std::ldexp(1.0, std::max(std::ilogb(x), -126) - 23);
}

}  // namespace

double storage_step(const RendererModel& model, double window) {
  double told = spacing(window);
  if (model.written && is_logarithmic(model.written->mapping)) {
    const double scale = model.written->scale;  // no finer than log2 is
    told = std::max(told, std::abs(scale) * log2_error(window / scale));
  } else if (!model.written && model.mapping == Mapping::opengl) {
    told = std::max(told, 0x1p-24);  // nor z_ndc/2 + 1/2 than numbers of about a half
  }
  if (model.storage == Storage::float16) return 0x1p13 * told;
  if (!is_unorm(model.storage)) return told;
  return std::max(told, 1 / (std::ldexp(1.0, bits_of(model.storage)) - 1));
}

StoredValues::StoredValues(const Camera& camera, const OtherMap& other, const RendererModel& model)
    : other_(other), model_(model) {
  if (!is_raster()) return;
  window_ = window_depth(camera.projection, model.stored_mapping(), camera.near, camera.far);
  sign_ = window_.reversed() ? -1 : 1;
}

/// Of a fragment's value. Window depths beyond the far plane's infinity are infinitely far.
double StoredValues::depth_of(double value) const {
  if (!is_raster() || !std::isfinite(value)) return value;
  return window_.to_depth(sign_ * value);
}

Interval StoredValues::as_depths(const Fragment& f) const {
  const double lower = depth_of(f.value.lower), upper = depth_of(f.value.upper);
  // Decoded and rounded to binary32.
  return {lower - 2 * unit_roundoff * std::abs(lower),
          upper == infinity ? upper : upper + 2 * unit_roundoff * std::abs(upper)};
}

Interval StoredValues::interval(const Fragment& f) const {
  return has_windows() || !is_raster() ? f.value : as_depths(f);
}

double StoredValues::exact(const Fragment& f) const {
  return has_windows() ? f.exact : depth_of(f.exact);
}

double StoredValues::limit(double value) const {
  if (has_windows() || !is_raster()) return value;
  const double depth = depth_of(value);
  return depth == infinity ? depth : depth + 2 * unit_roundoff * std::abs(depth);
}

double StoredValues::other(std::size_t pixel) const {
  return has_windows() ? sign_ * other_.windows[pixel] : other_.depths[pixel];
}

double StoredValues::window_of(std::size_t pixel) const {
  return has_windows() ? other_.windows[pixel] : window_.of_depth(other_.depths[pixel]);
}

bool StoredValues::is_nearest(std::size_t pixel, double depth) const {
  if (!has_windows()) {
    return static_cast<float>(other_.depths[pixel]) == static_cast<float>(depth);
  }
  const double exact = window_.of_depth(depth) + model_.bias;
  if (!is_unorm(model_.storage)) return other_.windows[pixel] == static_cast<float>(exact);
  const double codes = std::ldexp(1.0, bits_of(model_.storage)) - 1;
  return std::abs(other_.windows[pixel] * codes - std::nearbyint(exact * codes)) < 0.25;
}

bool StoredValues::is_neighbour(std::size_t pixel, double depth) const {
  if (!is_raster()) {
    return std::abs(other_.depths[pixel] - depth) <= spacing(depth);
  }
  const double exact = window_.of_depth(depth) + model_.bias;
  return std::abs(window_of(pixel) - exact) <= storage_step(model_, exact);
}

double StoredValues::steps(const Fragment& f, double depth) const {
  const double width = f.value.upper - f.value.lower;
  return width / (is_raster() ? storage_step(model_, window_.of_depth(depth)) : spacing(depth));
}

double StoredValues::bias_steps(std::size_t pixel, const Fragment& f) const {
  const double expected = sign_ * f.exact;
  return (window_of(pixel) - expected) / storage_step(model_, expected);
}

}  // namespace fathom::attribution
