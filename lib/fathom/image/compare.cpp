#include "fathom/image/compare.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/compare_internal.h"
#include "fathom/image/error_metrics.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"
#include "fathom/text/decimal.h"

namespace fathom {
using namespace image;

namespace {

PixelPosition position_of(std::size_t k, std::uint32_t width) {
  return {static_cast<std::uint32_t>(k % width), static_cast<std::uint32_t>(k / width)};
}

/// Integers in the order of the numbers, one apart for neighbours; 0 for both zeros.
template <class Float, class Integer>
Integer ordinal(Float value) {
  const auto bits = std::bit_cast<Integer>(value);
  return bits < 0 ? std::numeric_limits<Integer>::min() - bits : bits;
}

double steps_binary32(float a, float b) {
  const auto from = std::int64_t{ordinal<float, std::int32_t>(a)};
  const auto to = std::int64_t{ordinal<float, std::int32_t>(b)};
  return static_cast<double>(std::abs(from - to));
}

double steps_binary64(double a, double b) {
  const auto from = ordinal<double, std::int64_t>(a), to = ordinal<double, std::int64_t>(b);
  const auto distance = from > to
                            ? static_cast<std::uint64_t>(from) - static_cast<std::uint64_t>(to)
                            : static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
  return static_cast<double>(distance);
}

BackgroundRule rule_for(const DepthMap& map, const ImageChannel& channel,
                        const std::optional<double>& given) {
  if (kind_of(channel) != ChannelKind::depth) return {};
  if (!given) return background_of(map, channel);
  return {.value = std::isfinite(*given) ? given : std::nullopt};
}

/// The only depth channel of a map, regardless of its name.
const ImageChannel* lone_depth(const DepthMap& map) {
  const ImageChannel* found = nullptr;
  for (const ImageChannel& channel : map.channels) {
    if (kind_of(channel) != ChannelKind::depth) continue;
    if (found) return nullptr;
    found = &channel;
  }
  return found;
}

const ImageChannel& named(const DepthMap& map, const std::string& name, const char* which) {
  if (const ImageChannel* channel = map.find(own_channel_name(map, name))) return *channel;
  throw missing_channel(map, name, std::string("the ") + which + " map");
}

/// The measurements at one pixel that shows a surface in both maps.
struct Measure {
  bool bit_equal = false, commensurable = true;
  double absolute = 0, relative = 0, ulp = 0;

  [[nodiscard]] double by(DifferenceMeasure measure) const {
    switch (measure) {
      case DifferenceMeasure::absolute:
        return absolute;
      case DifferenceMeasure::relative:
        return relative;
      case DifferenceMeasure::ulp:
        return ulp;
    }
    return absolute;
  }
};

Measure measure(const Reading& a, const Reading& b, std::size_t k) {
  const double x = a.value(k), y = b.value(k);
  Measure m;
  m.bit_equal = a.bits(k) == b.bits(k) && a.type() == b.type();
  if (m.bit_equal || x == y || (std::isnan(x) && std::isnan(y))) return m;
  if (!std::isfinite(x) || !std::isfinite(y)) return {false, false, 0, 0, 0};
  m.absolute = std::abs(x - y);
  m.relative = m.absolute / std::max(std::abs(x), std::abs(y));
  if (a.is_codes() && b.is_codes() && a.scale() == b.scale())
    m.ulp = std::abs(static_cast<double>(a.bits(k)) - static_cast<double>(b.bits(k)));
  else if (a.is_binary64() && b.is_binary64())
    m.ulp = steps_binary64(x, y);
  else
    m.ulp = steps_binary32(static_cast<float>(x), static_cast<float>(y));
  return m;
}

bool is_beyond(const Measure& m, const CompareOptions& options) {
  return !m.commensurable ||
         (m.ulp > options.tolerance_ulp && m.absolute > options.tolerance_absolute &&
          m.relative > options.tolerance_relative);
}

void require_tolerance(const char* setting, double tolerance) {
  if (!(tolerance >= 0)) throw UsageError(Setting{setting}, "expected a number of 0 or more");
}

/// Differences of one kind at all compared pixels, and where the largest is.
struct Differences {
  std::vector<double> values;
  std::size_t worst = 0;
  double max = -1;

  void add(double value, std::size_t pixel) {
    if (value > max) {
      max = value;
      worst = pixel;
    }
    values.push_back(value);
  }

  DifferenceSummary summary(std::uint32_t width) {
    if (values.empty()) return {};
    DifferenceSummary s;
    s.max = max;
    s.worst = position_of(worst, width);
    double sum = 0;
    for (const double v : values) sum += v;
    s.mean = sum / static_cast<double>(values.size());
    std::sort(values.begin(), values.end());
    s.p50 = image::nearest_rank(values, 500);
    s.p90 = image::nearest_rank(values, 900);
    s.p99 = image::nearest_rank(values, 990);
    s.p99_9 = image::nearest_rank(values, 999);
    return s;
  }
};

constexpr const char* no_scale =
    ": the codes carry no scale and count as depths; give 'fathom convert' one by --png-scale, "
    "e.g. 1000, and compare its output (in Python fathom.Map({'Z': codes}, scale=1000))";

void add_notes(ChannelComparison& result, const ChannelPair& pair) {
  if (!pair.truth_rule.note.empty()) result.notes.push_back("truth: " + pair.truth_rule.note);
  if (!pair.other_rule.note.empty()) result.notes.push_back("other: " + pair.other_rule.note);
  const Reading a(pair.truth, pair.truth_scale), b(pair.other, pair.other_scale);
  for (const auto& [reading, name] : {std::pair(&a, "truth"), std::pair(&b, "other")})
    if (reading->is_codes() && !reading->scale() && a.type() != b.type())
      result.notes.push_back(std::string(name) + no_scale);
  if (a.type() != b.type())
    result.notes.emplace_back(
        "the channels are stored in different types: ulp differences count binary32 numbers");
}

/// One map of a pair: its values, and where it and the other map show surfaces.
struct Side {
  const char* name;
  Reading reading;
  const std::vector<std::uint8_t>&mask, &mask_of_other;
};

/// The value that seems to be the background of a map where the other map shows no surface: its
/// greatest, such as the depth of the far plane, if nine tenths of these pixels have it and no
/// pixel at which both show a surface.
std::optional<std::string> note_of_background(const Side& side) {
  double greatest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < side.mask.size(); ++k)
    if (side.mask[k] != 0) greatest = std::max(greatest, side.reading.value(k));
  std::uint64_t only_here = 0, equal = 0;
  for (std::size_t k = 0; k < side.mask.size(); ++k) {
    if (side.mask[k] == 0) continue;
    const bool is_greatest = side.reading.value(k) == greatest;
    if (side.mask_of_other[k] == 0) {
      ++only_here;
      equal += is_greatest;
    } else if (is_greatest) {
      return std::nullopt;
    }
  }
  if (!std::isfinite(greatest) || equal < 2 || equal * 10 < only_here * 9) return std::nullopt;
  const std::string value = text::shortest_decimal(greatest), name = side.name;
  return name + ": the background is " + value + ", not infinite, at " +
         text::counted(equal, "pixel") + ": give --" + name + "-background " + value +
         " (in Python " + name + "_background=" + value + ")";
}

void add_notes_of_backgrounds(ChannelComparison& result, const ChannelPair& pair) {
  if (kind_of(pair.truth) != ChannelKind::depth) return;
  const Reading a(pair.truth, pair.truth_scale), b(pair.other, pair.other_scale);
  for (const Side& side : {Side{"truth", a, pair.truth_mask, pair.other_mask},
                           Side{"other", b, pair.other_mask, pair.truth_mask}})
    if (auto note = note_of_background(side)) result.notes.push_back(std::move(*note));
}

template <class Errors>
auto errors_of(const ChannelPair& pair) {
  const Reading a(pair.truth, pair.truth_scale), b(pair.other, pair.other_scale);
  Errors errors;
  for (std::size_t k = 0; k < pair.truth_mask.size(); ++k)
    if (pair.truth_mask[k] != 0 && pair.other_mask[k] != 0) errors.add(a.value(k), b.value(k));
  return errors.result();
}

void add_metrics(ChannelComparison& result, const ChannelPair& pair, Metrics metrics) {
  if (metrics == Metrics::none || kind_of(pair.truth) != ChannelKind::depth) return;
  const std::string& name = pair.truth.name;
  const bool disparity =
      metrics == Metrics::of_disparity || name.substr(name.rfind('.') + 1) == "disparity";
  if (disparity)
    result.disparity_metrics = errors_of<DisparityErrors>(pair);
  else
    result.depth_metrics = errors_of<DepthErrors>(pair);
}

ChannelComparison compare_channel(const ChannelPair& pair, const CompareOptions& options) {
  ChannelComparison result;
  result.truth_channel = pair.truth.name;
  result.other_channel = pair.other.name;
  result.identifiers = pair.identifiers();
  const ChannelKind kind = kind_of(pair.truth);
  result.is_around_zero = kind == ChannelKind::direction || kind == ChannelKind::position;
  result.pixels = pair.truth_mask.size();
  add_notes(result, pair);
  const Reading a(pair.truth, pair.truth_scale), b(pair.other, pair.other_scale);
  Differences absolute, relative, ulp;
  const auto mark = [&](std::optional<PixelPosition>& first, std::size_t k) {
    if (!first) first = position_of(k, pair.width);
  };
  for (std::size_t k = 0; k < result.pixels; ++k) {
    const bool in_truth = pair.truth_mask[k] != 0, in_other = pair.other_mask[k] != 0;
    result.both += in_truth && in_other;
    result.neither += !in_truth && !in_other;
    result.only_truth += in_truth && !in_other;
    result.only_other += !in_truth && in_other;
    if (in_truth != in_other) mark(result.first_coverage_disagreement, k);
    if (!in_truth || !in_other) continue;
    if (result.identifiers) {
      const bool equal = a.bits(k) == b.bits(k);
      result.bit_equal += equal;
      result.different_identifiers += !equal;
      result.beyond_tolerance += !equal;
      if (!equal) mark(result.first_mismatch, k);
      continue;
    }
    const Measure m = measure(a, b, k);
    result.bit_equal += m.bit_equal;
    result.incommensurable += !m.commensurable;
    result.beyond_tolerance += is_beyond(m, options);
    if (!m.commensurable) {
      mark(result.first_mismatch, k);
      continue;
    }
    ++result.compared;
    absolute.add(m.absolute, k);
    relative.add(m.relative, k);
    ulp.add(m.ulp, k);
  }
  add_notes_of_backgrounds(result, pair);
  add_metrics(result, pair, options.metrics);
  result.absolute = absolute.summary(pair.width);
  result.relative = relative.summary(pair.width);
  result.ulp = ulp.summary(pair.width);
  return result;
}

}  // namespace

ChannelPair image::make_pair(const DepthMap& truth, const ImageChannel& a, const DepthMap& other,
                             const ImageChannel& b, const CompareOptions& options) {
  const bool integers_a = std::holds_alternative<Samples<std::uint32_t>>(a.values);
  const bool integers_b = std::holds_alternative<Samples<std::uint32_t>>(b.values);
  if (integers_a != integers_b)
    throw InputError("channel '" + a.name +
                     "' holds identifiers in one map and numbers in the other");
  ChannelPair pair{a,
                   b,
                   truth.png_scale,
                   other.png_scale,
                   rule_for(truth, a, options.truth_background),
                   rule_for(other, b, options.other_background),
                   {},
                   {},
                   truth.width};
  // Identifiers distinguish an overflowed depth from background, but only if both maps have them.
  const bool by_identifiers = identifiers_of(truth) && identifiers_of(other);
  pair.truth_mask = surface_mask(truth, a,
                                 options.truth_background || kind_of(a) == ChannelKind::depth
                                     ? std::optional(pair.truth_rule)
                                     : std::nullopt,
                                 by_identifiers);
  pair.other_mask = surface_mask(other, b,
                                 options.other_background || kind_of(b) == ChannelKind::depth
                                     ? std::optional(pair.other_rule)
                                     : std::nullopt,
                                 by_identifiers);
  return pair;
}

PairedNames image::paired_channels(const DepthMap& truth, const DepthMap& other,
                                   const CompareOptions& options) {
  require_valid(truth);
  require_valid(other);
  require_tolerance("tolerance_ulp", options.tolerance_ulp);
  require_tolerance("tolerance_absolute", options.tolerance_absolute);
  require_tolerance("tolerance_relative", options.tolerance_relative);
  if (truth.width != other.width || truth.height != other.height)
    throw InputError("the maps differ in size: " + std::to_string(truth.width) + "×" +
                     std::to_string(truth.height) + " and " + std::to_string(other.width) + "×" +
                     std::to_string(other.height));
  PairedNames result;
  if (!options.channel.empty() || !options.other_channel.empty()) {
    const std::string& a = options.channel.empty() ? options.other_channel : options.channel;
    const std::string& b = options.other_channel.empty() ? a : options.other_channel;
    const ImageChannel& of_truth = named(truth, a, "first");
    result.pairs.emplace_back(&of_truth, &named(other, b, "second"));
    return result;
  }
  for (const ImageChannel& channel : truth.channels)
    if (const ImageChannel* match = other.find(channel.name))
      result.pairs.emplace_back(&channel, match);
  if (!result.pairs.empty()) return result;
  const ImageChannel *a = lone_depth(truth), *b = lone_depth(other);
  if (const ImageChannel* z = truth.find("Z")) a = z;
  if (const ImageChannel* z = other.find("Z")) b = z;
  if (!a || !b) throw InputError("the maps have no channel in common: name one of each");
  result.pairs.emplace_back(a, b);
  result.note = "no channel in common: '" + a->name + "' is compared with '" + b->name + "'";
  return result;
}

bool MapComparison::within_tolerance() const {
  return std::all_of(channels.begin(), channels.end(),
                     [](const ChannelComparison& c) { return c.within_tolerance(); });
}

MapComparison compare_maps(const DepthMap& truth, const DepthMap& other,
                           const CompareOptions& options) {
  const StandardArithmetic standard;
  const PairedNames names = paired_channels(truth, other, options);
  MapComparison result;
  if (!names.note.empty()) result.notes.push_back(names.note);
  for (const auto& [a, b] : names.pairs)
    result.channels.push_back(compare_channel(make_pair(truth, *a, other, *b, options), options));
  for (const ImageChannel& channel : truth.channels)
    if (!other.find(channel.name)) result.only_in_truth.push_back(channel.name);
  for (const ImageChannel& channel : other.channels)
    if (!truth.find(channel.name)) result.only_in_other.push_back(channel.name);
  return result;
}

std::vector<PixelDifference> image::pixel_differences(const ChannelPair& pair,
                                                      DifferenceMeasure by) {
  const Reading a(pair.truth, pair.truth_scale), b(pair.other, pair.other_scale);
  std::vector<PixelDifference> result(pair.truth_mask.size());
  for (std::size_t k = 0; k < result.size(); ++k) {
    using Kind = PixelDifference::Kind;
    const bool in_truth = pair.truth_mask[k] != 0, in_other = pair.other_mask[k] != 0;
    if (!in_truth && !in_other) continue;
    if (in_truth != in_other) {
      result[k].kind = in_truth ? Kind::only_truth : Kind::only_other;
    } else if (pair.identifiers()) {
      result[k].kind = a.bits(k) == b.bits(k) ? Kind::equal : Kind::incommensurable;
    } else {
      const Measure m = measure(a, b, k);
      const double difference = m.by(by);
      result[k] = {!m.commensurable  ? Kind::incommensurable
                   : difference == 0 ? Kind::equal
                                     : Kind::different,
                   difference};
    }
  }
  return result;
}

}  // namespace fathom
