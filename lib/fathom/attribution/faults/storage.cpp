#include "fathom/attribution/faults/storage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "fathom/attribution/model/window_depth.h"
#include "fathom/attribution/pixels/stored_values.h"
#include "fathom/camera/camera.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double u = unit_roundoff<float>;

/// How improbable it has to be that all distinct values fit by chance, as a power of two.
constexpr double least_bits = 20;
/// Distinct values from which a step may be estimated.
constexpr std::size_t least_distinct = 24;

/// The distinct depths of surfaces, in ascending order.
std::vector<double> distinct_depths(const OtherMap& other) {
  std::vector<double> depths;
  for (const double d : other.depths) {
    if (std::abs(d) < infinity) depths.push_back(d);
  }
  std::sort(depths.begin(), depths.end());
  depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
  return depths;
}

/// Greatest error of a recorded value through the rounding of the depth to binary32.
double tolerance(const RecordedDepth& r, double depth) {
  const double moved = depth * (1 + 4 * u);
  return std::abs(r.exact(moved) - r.exact(depth)) + 4 * u * std::abs(r.exact(depth));
}

bool fits(const RecordedDepth& r, const std::vector<double>& depths) {
  double bits = 0;
  const bool all = std::all_of(depths.begin(), depths.end(), [&](double d) {
    const double value = r.exact(d), allowed = tolerance(r, d);
    bits += std::log2(r.step_at(value) / (2 * allowed));
    return 16 * allowed <= r.step_at(value) && std::abs(r.rounded(value) - value) <= allowed;
  });
  return all && bits >= least_bits;
}

/// Depths that are apart by one step, at a typical depth.
double coarseness(const RecordedDepth& r, double depth) {
  const double value = r.exact(depth), step = r.step_at(value);
  return std::abs(r.to_depth(value + step / 2) - r.to_depth(value - step / 2));
}

RecordedDepth multiples_of(double step) {
  return {.rounding = RecordedDepth::Rounding::nearest, .step = step};
}

/// Codes of n bits from 0 at near to 1 at far.
RecordedDepth codes(const Camera& c, bool of_windows, Mapping mapping, int bits) {
  RecordedDepth r{.rounding = RecordedDepth::Rounding::nearest,
                  .step = 1 / (std::ldexp(1.0, bits) - 1)};
  const WindowDepth window = window_depth(c.projection.model, mapping, c.near, c.far);
  if (of_windows && window.perspective) {
    r.term = DepthTerm::inverse;
    r.factor = window.b;
    r.offset = window.a;
  } else {
    r.factor = 1 / (c.far - c.near);
    r.offset = -c.near / (c.far - c.near);
  }
  return r;
}

void add_codes(const Camera& camera, const RendererModel& model,
               std::vector<CoarseStorage>& storages) {
  if (!has_clip_planes(camera)) return;
  const auto* const raster = std::get_if<RasterModel>(&model.kind);
  for (const int bits : {8, 10, 12, 16}) {
    if (is_perspective(camera.projection)) {
      storages.push_back(
          {codes(camera, true, raster != nullptr ? raster->mapping : Mapping::opengl, bits),
           fmt::format("window depths in {} bits", bits)});
    }
    storages.push_back({codes(camera, false, Mapping::opengl, bits),
                        fmt::format("{} bits from near to far", bits)});
  }
}

std::string text_of_step(double step) {
  const double per_unit = std::nearbyint(1 / step);
  const bool is_part = std::abs(per_unit * step - 1) < 1e-6;
  std::string text = is_part && per_unit > 1 && std::fmod(per_unit, 10) != 0
                         ? fmt::format("multiples of 1/{}", per_unit)
                         : fmt::format("multiples of {:.7g}", step);
  if (is_part && per_unit == 1000) text += ", whole millimetres if the scene is in metres";
  return text;
}

/// A window depth's own step, as a depth; recorded values must be at least twice as coarse.
double own_coarseness(const Camera& camera, const RendererModel& model, double depth) {
  if (model.recorded) return coarseness(*model.recorded, depth);
  const auto* const raster = std::get_if<RasterModel>(&model.kind);
  if (raster == nullptr) return binary32_spacing(depth);
  const WindowDepth window =
      window_depth(camera.projection.model, raster->stored_mapping(), camera.near, camera.far);
  const double z = window.of_depth(depth);
  const double step = storage_step(*raster, z);
  return std::abs(window.to_depth(z + step / 2) - window.to_depth(z - step / 2));
}

}  // namespace

/// Mean of stored minus exact values: zero, half a step, or the bias of another fault.
bool is_rounded_down(const Truth& truth, const OtherMap& other, const RecordedDepth& recorded) {
  double sum = 0, pixels = 0;
  for (std::size_t i = 0; i < truth.depths.size(); ++i) {
    if (!(truth.depths[i] < infinity) || !(std::abs(other.depths[i]) < infinity)) continue;
    const double off = recorded.exact(other.depths[i]) - recorded.exact(truth.depths[i]);
    if (!(std::abs(off) < 2 * recorded.step)) continue;  // another surface
    sum += off;
    ++pixels;
  }
  const double half = -recorded.step / 2 * pixels;
  return sum < half / 2 && sum > 1.5 * half;
}

/// Candidates are fractions of the least difference of neighbours, which is a small multiple of the
/// step, made exact by the greatest value.
std::optional<double> common_step(const std::vector<double>& values) {
  if (values.size() < least_distinct) return std::nullopt;
  double least = infinity;
  const double greatest = std::max(std::abs(values.front()), std::abs(values.back()));
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double difference = values[i] - values[i - 1];
    if (difference > 32 * u * greatest) least = std::min(least, difference);
  }
  if (!(least < infinity)) return std::nullopt;
  for (int part = 1; part <= 8; ++part) {
    double step = least / part;
    // From value to value, each a known multiple of the current estimate of the step: first the
    // differences from the least value, which begin with few steps, then the values themselves.
    const auto refine = [&step](double multiple) {
      const double k = std::nearbyint(multiple / step);
      if (k > 0 && std::abs(multiple / step - k) < 0.25) step = multiple / k;
    };
    for (const double v : values) refine(v - values.front());
    for (const double v : values) refine(std::abs(v));
    const double inverse = std::nearbyint(1 / step);
    // A step may be close to 1/n without being 1/n.
    const bool is_part = inverse > 0 && std::abs(inverse * step - 1) < 1e-5;
    if (is_part && fits(multiples_of(1 / inverse), values)) return 1 / inverse;
    if (fits(multiples_of(step), values)) return step;
  }
  return std::nullopt;
}

std::optional<CoarseStorage> coarse_storage(const Camera& camera, const OtherMap& other,
                                            const RendererModel& model) {
  const std::vector<double> depths = distinct_depths(other);
  if (depths.empty()) return std::nullopt;
  const double typical = depths[depths.size() / 2];
  std::vector<CoarseStorage> storages;
  for (const double per_unit : {1.0, 10.0, 100.0, 256.0, 512.0, 1000.0, 4000.0, 5000.0, 10000.0}) {
    storages.push_back({multiples_of(1 / per_unit), text_of_step(1 / per_unit)});
  }
  if (const std::optional<double> step = common_step(depths)) {
    storages.push_back({multiples_of(*step), text_of_step(*step)});
  }
  add_codes(camera, model, storages);
  storages.push_back({{.rounding = RecordedDepth::Rounding::binary16}, "half floats (binary16)"});
  std::optional<CoarseStorage> coarsest;
  for (const CoarseStorage& s : storages) {
    const double step = coarseness(s.recorded, typical);
    if (!(step > 2 * own_coarseness(camera, model, typical)) || !fits(s.recorded, depths)) continue;
    const double coarsest_step = coarsest ? coarseness(coarsest->recorded, typical) : 0;
    // Half floats are multiples of a step as long as they lie between two powers of two.
    const bool is_half = s.recorded.rounding == RecordedDepth::Rounding::binary16;
    if (step > 1.0001 * coarsest_step) {
      coarsest = s;
    } else if (is_half && step > 0.9999 * coarsest_step) {
      coarsest = CoarseStorage{s.recorded, s.text + ", or " + coarsest->text};
    }
  }
  return coarsest;
}

namespace {

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

}  // namespace

double rounded_to_digits(double value, int digits) {
  const double unit = std::pow(10.0, digits - 1 - std::floor(std::log10(value)));
  return std::nearbyint(value * unit) / unit;
}

namespace {

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
