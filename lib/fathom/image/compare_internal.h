#pragma once

#include <bit>
#include <utility>

#include "fathom/image/compare.h"
#include "fathom/image/surface.h"

/// What compare.cpp and difference_picture.cpp share.
namespace fathom::image {

/// The values of a channel of any type: as binary64 (codes decoded where their scale is known), and
/// as bits.
class Reading {
 public:
  Reading(const ImageChannel& channel, const std::optional<double>& scale)
      : values_(channel.values), scale_(scale) {}

  [[nodiscard]] double value(std::size_t k) const {
    const double stored =
        std::visit([k](const auto& v) { return static_cast<double>(v[k]); }, values_);
    return is_codes() && scale_ ? stored / *scale_ : stored;
  }
  [[nodiscard]] std::uint64_t bits(std::size_t k) const {
    if (const auto* v = std::get_if<Samples<float>>(&values_))
      return std::bit_cast<std::uint32_t>((*v)[k]);
    if (const auto* v = std::get_if<Samples<double>>(&values_))
      return std::bit_cast<std::uint64_t>((*v)[k]);
    if (const auto* v = std::get_if<Samples<std::uint16_t>>(&values_)) return (*v)[k];
    return std::get<Samples<std::uint32_t>>(values_)[k];
  }
  /// Bit patterns mean the same in two channels of equal type (and, for codes, of equal scale).
  [[nodiscard]] std::pair<std::size_t, std::optional<double>> type() const {
    std::pair<std::size_t, std::optional<double>> result(values_.index(), std::nullopt);
    if (is_codes()) result.second = scale_;
    return result;
  }
  [[nodiscard]] bool is_binary64() const {
    return std::holds_alternative<Samples<double>>(values_);
  }
  [[nodiscard]] bool is_codes() const {
    return std::holds_alternative<Samples<std::uint16_t>>(values_);
  }
  [[nodiscard]] const std::optional<double>& scale() const { return scale_; }

 private:
  const decltype(ImageChannel::values)& values_;
  std::optional<double> scale_;
};

/// One channel of each map, and which of its values are background.
struct ChannelPair {
  const ImageChannel& truth;
  const ImageChannel& other;
  std::optional<double> truth_scale, other_scale;
  BackgroundRule truth_rule, other_rule;
  std::vector<std::uint8_t> truth_mask, other_mask;
  std::uint32_t width;

  [[nodiscard]] bool identifiers() const {
    return std::holds_alternative<Samples<std::uint32_t>>(truth.values);
  }
};

ChannelPair make_pair(const DepthMap& truth, const ImageChannel& a, const DepthMap& other,
                      const ImageChannel& b, const CompareOptions& options);

/// Which channels are compared with which; the sizes have been checked.
struct PairedNames {
  std::vector<std::pair<const ImageChannel*, const ImageChannel*>> pairs;
  std::string note;
};

PairedNames paired_channels(const DepthMap& truth, const DepthMap& other,
                            const CompareOptions& options);

/// One pixel of a heat map.
struct PixelDifference {
  enum class Kind { neither, equal, different, only_truth, only_other, incommensurable };
  Kind kind = Kind::neither;
  /// By the requested measure; above 0 if `kind` is `different`.
  double difference = 0;
};

std::vector<PixelDifference> pixel_differences(const ChannelPair& pair, DifferenceMeasure by);

}  // namespace fathom::image
