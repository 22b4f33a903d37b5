#pragma once

#include <algorithm>
#include <bit>
#include <cmath>

#include "fathom/fast/certified_writer.h"
#include "fathom/numeric/last_bit.h"

// For fast_channels.cpp alone.
namespace fathom {

/// A double-word that is exact and of one word makes a product with `scale` that is exact.
inline bool store(const EncodedValues& values, std::size_t pixel, const Certified<WordPair>& x,
                  double scale) {
  if (values.binary32) {
    const auto rounded = to_binary32(x.value, x.error);
    if (rounded) values.binary32[pixel] = *rounded;
    return rounded.has_value();
  }
  if (values.binary64) {
    const auto rounded = to_binary64(x.value, x.error);
    if (rounded) values.binary64[pixel] = *rounded;
    return rounded.has_value();
  }
  using Real = DoubleWord<false>;
  const Real scaled = Real(x.value) * scale;
  const bool is_exact = x.error == 0 && x.value.lo == 0;
  const double error = is_exact ? 0 : (x.error * scale + scaled.hi * epsilon<Real>)*slack;
  const auto code = to_code(scaled, error);
  if (code) values.codes[pixel] = *code;
  return code.has_value();
}

/// At least |n·d| at a sample: from the leading words, whose own errors are 3u of the terms.
inline double divisor_size(const DepthForms<WordPair>& depth, const ImagePoint& s,
                           bool perspective) {
  if (!perspective) return std::abs(depth.constant.value.hi) * slack + depth.constant.error;
  const auto& [a, b, c, error] = depth.varying;
  const double terms = std::abs(c.hi) + std::abs(b.hi) * s.v + std::abs(a.hi) * s.u;
  return std::abs((c.hi + b.hi * s.v) + a.hi * s.u) + terms * 0x1p-50 + error;
}

/// One pixel while it is written: what the binary64 tier of fast_channel_rows.h did not settle, or
/// does not know. What several channels need is computed when first asked for.
class CertifiedWriter::Pixel {
 public:
  Pixel(CertifiedWriter& writer, const VisibleSurface& surface, Referee& referee,
        RenderStatistics& statistics)
      : writer_(writer),
        values_(writer.values_),
        surface_(surface),
        referee_(referee),
        statistics_(statistics),
        s_{surface.sample.u, surface.sample.v} {}

  const std::array<float, 3>& normal() {
    Triangle& t = triangle();
    if (!t.has_normal) {
      find_normal();
      t.has_normal = true;
    }
    return t.normal;
  }

  void write_position(std::size_t k) {
    float& target = values_.position[k][surface_.pixel];
    if (triangle().usable) {
      if (const auto c = constant(k); c && take(to_binary32(*c, 0), target)) return count_wide();
      const Certified<WordPair> x = wide_position()[k];
      if (take(to_binary32(x.value, x.error), target)) return count_wide();
      if (is_zero(x, weight_bits() + world_bits(k))) {
        target = 0;
        return count_wide();
      }
    }
    count_exact();
    writer_.exact_.write_position(surface_.pixel, k, projected(), sample());
  }

  void write_barycentric(std::size_t k) {
    Triangle& t = triangle();
    float& target = values_.barycentric[k][surface_.pixel];
    if (t.usable) {
      if (!t.has_weights) {
        t.weights = weight_forms<double>(t.corners, t.object->rays, writer_.image_);
        t.has_weights = true;
      }
      const Certified<double> narrow = t.weights.at(k, s_);
      if (take(to_binary32(narrow.value, narrow.error), target)) return count_narrow();
      const Certified<double> divisor = t.weights.divisor.at(s_);
      if (is_zero(std::abs(narrow.value) + narrow.error, std::abs(divisor.value) + divisor.error,
                  weight_bits())) {
        target = 0;
        return count_narrow();
      }
      if (!wide_weights_) {
        wide_weights_ = writer_.wide_.weights(t.corners, t.object->rays, writer_.image_, s_);
      }
      const Certified<WordPair> x = (*wide_weights_)[k];
      if (take(to_binary32(x.value, x.error), target)) return count_wide();
      if (is_zero(x, weight_bits())) {
        target = 0;
        return count_wide();
      }
    }
    count_exact();
    writer_.exact_.write_barycentric(surface_.pixel, k, projected(), sample());
  }

  std::optional<EncodingFault> write_depth() {
    if (store_depth(values_.depth)) return std::nullopt;
    return writer_.exact_.write_depth(surface_.pixel, projected(), sample());
  }

  /// Perspective: depth times the length of the ray at depth 1. Orthographic: the depth.
  std::optional<EncodingFault> write_distance() {
    if (!writer_.image_.perspective) {
      if (store_depth(values_.distance)) return std::nullopt;
    } else if (store_distance()) {
      return std::nullopt;
    }
    return writer_.exact_.write_distance(surface_.pixel, projected(), sample());
  }

  void write_low_part() {
    if (triangle().usable &&
        (store_low_part(wide_depth()) || (exact_depth() && store_low_part({*exact_depth(), 0})))) {
      return count_wide();
    }
    count_exact();
    writer_.exact_.write_low_part(surface_.pixel, projected(), sample());
  }

 private:
  template <class T>
  static bool take(const std::optional<T>& rounded, T& target) {
    if (rounded) target = *rounded;
    return rounded.has_value();
  }

  void count_narrow() { ++statistics_.rounding.interval; }
  void count_wide() {
    ++statistics_.rounding.interval;
    ++statistics_.double_word_roundings;
  }
  void count_exact() { ++statistics_.rounding.exact; }

  Triangle& triangle() {
    if (!triangle_) triangle_ = &writer_.remember(surface_.triangle);
    return *triangle_;
  }
  const ProjectedTriangle& projected() { return referee_.projected(surface_.triangle); }
  [[nodiscard]] ImagePoint sample() const { return {s_.u, s_.v}; }

  /// Each component in its own tier; needs any pixel at which the triangle is visible.
  void find_normal() {
    Triangle& t = triangle();
    std::array<bool, 3> known{};
    if (t.usable) {
      const ObjectRays& world = writer_.rays_.world();
      const auto narrow = unit_normal<double>(t.corners, *t.object, world, writer_.image_, s_);
      std::optional<Vector<Certified<WordPair>>> wide;
      for (std::size_t i = 0; i < 3; ++i) {
        if (take(to_binary32(narrow[i].value, narrow[i].error), t.normal[i])) {
          known[i] = true;
          count_narrow();
          continue;
        }
        if (!wide) wide = writer_.wide_.normal(t.corners, *t.object, world, writer_.image_, s_);
        if (take(to_binary32((*wide)[i].value, (*wide)[i].error), t.normal[i])) {
          known[i] = true;
          count_wide();
        }
      }
    }
    if (known[0] && known[1] && known[2]) return;
    count_exact();
    writer_.exact_.write_normal(surface_.pixel, projected());
    for (std::size_t i = 0; i < 3; ++i) t.normal[i] = values_.normal[i][surface_.pixel];
  }

  bool store_depth(const EncodedValues& values) {
    const double scale = writer_.exact_.scale();
    if (triangle().usable &&
        (store(values, surface_.pixel, wide_depth(), scale) ||
         (exact_depth() &&
          store(values, surface_.pixel, Certified<WordPair>{*exact_depth(), 0}, scale)))) {
      count_wide();
      return true;
    }
    count_exact();
    return false;
  }

  bool store_distance() {
    const EncodedValues& values = values_.distance;
    const double scale = writer_.exact_.scale();
    if (triangle().usable) {
      const auto wide = [&](const Certified<WordPair>& depth) {
        return writer_.wide_.distance(depth, writer_.rays_, s_);
      };
      if (store(values, surface_.pixel, wide(wide_depth()), scale)) {
        count_wide();
        return true;
      }
    }
    count_exact();
    return false;
  }

  /// D − Z: hi − Z is exact, as Z is the binary32 number nearest to hi.
  bool store_low_part(const Certified<WordPair>& depth) {
    const auto Z = to_binary32(depth.value, depth.error);
    if (!Z) return false;
    const WordPair low = two_sum(depth.value.hi - static_cast<double>(*Z), depth.value.lo);
    return take(to_binary32(low, depth.error), values_.low[surface_.pixel]);
  }

  const Certified<WordPair>& wide_depth() {
    if (!wide_depth_) {
      Triangle& t = triangle();
      if (!t.has_depth) {
        t.depth = writer_.wide_.depth_forms(t.corners, t.object->rays, writer_.image_);
        t.has_depth = true;
      }
      wide_depth_ = writer_.wide_.depth(t.depth, s_, writer_.image_.perspective);
    }
    return *wide_depth_;
  }

  const Vector<Certified<WordPair>>& wide_position() {
    if (!wide_position_) {
      wide_position_ = writer_.wide_.position(writer_.rays_.world().rays, writer_.world_sizes_,
                                              writer_.image_.perspective, s_, wide_depth());
    }
    return *wide_position_;
  }

  /// The depth where it is known exactly: that of all three corners, or the binary32 or binary64
  /// number nearest to it.
  const std::optional<WordPair>& exact_depth() {
    if (!looked_for_exact_depth_) {
      looked_for_exact_depth_ = true;
      exact_depth_ = constant(3);
      const Certified<WordPair>& D = wide_depth();
      for (const double candidate :
           {static_cast<double>(static_cast<float>(D.value.hi)), D.value.hi}) {
        if (exact_depth_) break;
        const WordPair rest = two_sum(D.value.hi - candidate, D.value.lo);
        const long bits = std::min(image_bits(2), last_bit(candidate));
        if (is_zero({rest, D.error}, weight_bits() + bits)) exact_depth_ = {candidate, 0};
      }
    }
    return exact_depth_;
  }

  /// World coordinate k, or the depth (3), where it is the same number at all corners and found to
  /// be so.
  const std::optional<WordPair>& constant(std::size_t k) {
    Triangle& t = triangle();
    if ((t.constants_known >> k & 1) == 0) {
      t.constants_known |= static_cast<std::uint8_t>(1U << k);
      const ExactRow& row = k < 3 ? t.object->world_rows[k] : t.object->image_rows[2];
      const auto at_A = row.value_at(t.corners[0]);
      const auto is_at = [&](const MeshPoint& X) {
        const auto value = row.value_at(X);
        return value && value->hi == at_A->hi && value->lo == at_A->lo;
      };
      if (at_A && is_at(t.corners[1]) && is_at(t.corners[2])) t.constant[k] = at_A;
    }
    return t.constant[k];
  }

  // Values that are exactly 0. At a sample every interpolated value is Σ eᵢ·xᵢ / Σ eᵢ. The
  // coordinates of the corners are multiples of some powers of two, and so are U, V, W, the edge
  // functions eᵢ and the numerator; Σ eᵢ = det(H)·(n·d) up to its sign (fast_surface.h). So
  // |value|·|det H|·|n·d| is |numerator|, and if a bound of it is below the power of two of which
  // the numerator is a multiple, the value is 0.

  /// Exponents of powers of two of which the corners' coordinates are multiples.
  const std::array<long, 3>& corner_bits() {
    if (!corner_bits_) {
      const auto& [A, B, C] = triangle().corners;
      corner_bits_ = {std::min({last_bit(A.x), last_bit(B.x), last_bit(C.x)}),
                      std::min({last_bit(A.y), last_bit(B.y), last_bit(C.y)}),
                      std::min({last_bit(A.z), last_bit(B.z), last_bit(C.z)})};
    }
    return *corner_bits_;
  }
  long world_bits(std::size_t k) {
    return triangle().object->world_rows[k].last_bit_at(corner_bits());
  }
  long image_bits(std::size_t k) {
    return triangle().object->image_rows[k].last_bit_at(corner_bits());
  }
  /// Of the edge functions: det of two corners and a sample (multiples of ½).
  long weight_bits() {
    const long U = image_bits(0), V = image_bits(1);
    const long W = writer_.image_.perspective ? image_bits(2) : 0;
    return std::min({U + V, U + W - 1, V + W - 1});
  }
  /// Bounds of the magnitudes of the value and of n·d. 2⁻⁶⁰⁰: products that underflow on the way
  /// are below 2⁻⁷⁷⁴.
  bool is_zero(double value, double divisor, long numerator_bits) {
    if (numerator_bits < -600) return false;
    const double bound = value * divisor * triangle().object->determinant * slack;
    return bound < std::ldexp(1.0, static_cast<int>(std::min(numerator_bits, 900L)));
  }
  bool is_zero(const Certified<WordPair>& value, long numerator_bits) {
    Triangle& t = triangle();
    wide_depth();  // sets up t.depth
    return is_zero(std::abs(value.value.hi) + value.error,
                   divisor_size(t.depth, s_, writer_.image_.perspective), numerator_bits);
  }

  CertifiedWriter& writer_;
  const ChannelValues& values_;
  const VisibleSurface& surface_;
  Referee& referee_;
  RenderStatistics& statistics_;
  ImagePoint s_;
  Triangle* triangle_ = nullptr;
  std::optional<Certified<WordPair>> wide_depth_;
  std::optional<Vector<Certified<WordPair>>> wide_position_;
  std::optional<std::array<Certified<WordPair>, 2>> wide_weights_;
  bool looked_for_exact_depth_ = false;
  std::optional<WordPair> exact_depth_;
  std::optional<std::array<long, 3>> corner_bits_;
};

}  // namespace fathom
