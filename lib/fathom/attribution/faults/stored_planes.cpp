#include "fathom/attribution/faults/stored_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "fathom/camera/clip_planes.h"
#include "fathom/numeric/unit_roundoff.h"

namespace fathom::attribution {
namespace {

constexpr double u = unit_roundoff<float>;
constexpr std::size_t least_distinct = 24;
/// How improbable it has to be that all values fit by chance, as a power of two.
constexpr double least_bits = 20;

/// The values origin + k·step.
struct Lattice {
  double origin = 0, step = 0;

  [[nodiscard]] double code(double value) const { return std::nearbyint((value - origin) / step); }
};

/// How far roundings of a depth to binary32 move its inverse.
double tolerance(double inverse) {
  return 4 * u * inverse;
}

bool fits(const Lattice& lattice, const std::vector<double>& inverses) {
  double bits = 0;
  const bool all = std::all_of(inverses.begin(), inverses.end(), [&](double v) {
    const double allowed = tolerance(v);
    const double off = v - lattice.origin - lattice.step * lattice.code(v);
    bits += std::log2(lattice.step / (2 * allowed));
    return std::abs(off) <= allowed && 16 * allowed <= lattice.step;
  });
  return all && bits >= least_bits;
}

/// The distinct inverse depths of surfaces, in ascending order.
std::vector<double> inverse_depths(const OtherMap& other) {
  std::vector<double> inverses;
  for (const double depth : other.depths) {
    if (std::isfinite(depth) && depth > 0) inverses.push_back(1 / depth);
  }
  std::sort(inverses.begin(), inverses.end());
  inverses.erase(std::unique(inverses.begin(), inverses.end()), inverses.end());
  return inverses;
}

/// By least squares; `near_by`: a lattice that numbers the values rightly.
Lattice fitted(const Lattice& near_by, const std::vector<double>& values) {
  double mean = 0, mean_code = 0, products = 0, squares = 0;
  for (const double v : values) {
    mean += v;
    mean_code += near_by.code(v);
  }
  mean /= static_cast<double>(values.size());
  mean_code /= static_cast<double>(values.size());
  for (const double v : values) {
    const double code = near_by.code(v) - mean_code;
    products += code * (v - mean);
    squares += code * code;
  }
  const double step = products / squares;
  return {mean - step * mean_code, step};
}

/// The coarsest lattice through all values. The least difference of neighbours is a small multiple
/// of the step, which values farther and farther away make exact.
std::optional<Lattice> lattice_of(const std::vector<double>& values) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double difference = values[i] - values[i - 1];
    if (difference > 4 * tolerance(values[i])) least = std::min(least, difference);
  }
  if (!std::isfinite(least)) return std::nullopt;
  constexpr int most_parts = 8;
  for (int part = 1; part <= most_parts; ++part) {
    Lattice lattice{values.front(), least / part};
    for (const double v : values) {
      const double code = lattice.code(v), place = (v - lattice.origin) / lattice.step;
      if (code > 0 && std::abs(place - code) < 0.25) lattice.step = (v - lattice.origin) / code;
    }
    lattice = fitted(lattice, values);
    if (fits(lattice, values)) return lattice;
  }
  return std::nullopt;
}

Lattice lattice_between(const ClipPlanes& planes, double codes) {
  return {1 / planes.far, (1 / planes.near - 1 / planes.far) / codes};
}

double rounded_to_digits(double value, int digits) {
  const double unit = std::pow(10.0, digits - 1 - std::floor(std::log10(value)));
  return std::nearbyint(value * unit) / unit;
}

/// The camera's planes, then planes of one digit, then of two digits, beyond all surfaces.
std::vector<double> likely_fars(const Camera& camera, double greatest_depth) {
  std::vector<double> fars{camera.far};
  constexpr int decades = 8;
  for (const int digits : {1, 2}) {
    const int first = digits == 1 ? 1 : 10, last = 10 * first;
    double unit = std::pow(10.0, std::floor(std::log10(greatest_depth)) - digits + 1);
    for (int decade = 0; decade < decades; ++decade, unit *= 10) {
      for (int mantissa = first; mantissa < last; ++mantissa) {
        const double far = rounded_to_digits(mantissa * unit, digits);
        if (far > greatest_depth) fars.push_back(far);
      }
    }
  }
  return fars;
}

/// The greatest code of the model's window depths; nothing where these are not such codes.
std::optional<double> codes_of(const Camera& camera, const OtherMap& other,
                               const RendererModel& model) {
  const auto* const raster = std::get_if<RasterModel>(&model.kind);
  const bool has_codes = raster != nullptr && raster->mapping == Mapping::opengl &&
                         is_unorm(raster->storage) && !raster->written && !model.recorded;
  const bool is_decoded =
      is_perspective(camera.projection) && has_clip_planes(camera) && other.windows.empty();
  if (!has_codes || !is_decoded) return std::nullopt;
  return greatest_code(raster->storage);
}

}  // namespace

std::optional<ClipPlanes> stored_planes(const Camera& camera, const OtherMap& other,
                                        const RendererModel& model) {
  const std::optional<double> codes = codes_of(camera, other, model);
  if (!codes) return std::nullopt;
  const std::vector<double> inverses = inverse_depths(other);
  if (inverses.size() < least_distinct) return std::nullopt;
  if (fits(lattice_between({camera.near, camera.far}, *codes), inverses)) return std::nullopt;
  const std::optional<Lattice> lattice = lattice_of(inverses);
  if (!lattice) return std::nullopt;
  constexpr int digits = 3;
  for (const double far : likely_fars(camera, 1 / inverses.front())) {
    const double near = rounded_to_digits(1 / (1 / far + lattice->step * *codes), digits);
    const ClipPlanes planes{near, far};
    if (near < far && near * inverses.back() <= 1 &&
        fits(lattice_between(planes, *codes), inverses)) {
      return planes;
    }
  }
  return std::nullopt;
}

}  // namespace fathom::attribution
