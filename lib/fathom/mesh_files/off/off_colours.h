#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace fathom::mesh_files {

/// The colours of the vertices of an OFF file. Whether its numbers are fractions of 1 or of 255 is
/// decided at the end: they are fractions of 255 if all are integers and any is greater than 1.
class OffColours {
 public:
  using Colour = std::array<float, 4>;
  static constexpr float opaque = std::numeric_limits<float>::quiet_NaN();

  /// Of the vertices in their order, each at most once; alpha may be `opaque`.
  void add(std::uint64_t vertex, const Colour& colour, bool integers) {
    colours_.resize(vertex, none);
    colours_.push_back(colour);
    integers_ = integers_ && integers;
    for (const float c : colour) greatest_ = std::max(greatest_, std::isnan(c) ? 0 : c);
  }

  /// One for each vertex, white where none was given; empty if none was at all.
  std::vector<Colour> finish(std::uint64_t vertices) {
    if (colours_.empty()) return {};
    colours_.resize(vertices, none);
    const float whole = integers_ && greatest_ > 1 ? 255 : 1;
    for (Colour& colour : colours_) {
      if (std::isnan(colour[0])) colour = {whole, whole, whole, whole};
      if (std::isnan(colour[3])) colour[3] = whole;
      for (float& c : colour) c = std::clamp(c / whole, 0.0F, 1.0F);
    }
    return std::move(colours_);
  }

 private:
  static constexpr Colour none{opaque, opaque, opaque, opaque};

  std::vector<Colour> colours_;
  bool integers_ = true;
  float greatest_ = 0;
};

}  // namespace fathom::mesh_files
