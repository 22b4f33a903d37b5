#include "validation/colour/colour_comparison.h"

#include <algorithm>
#include <cstdlib>

namespace fathom::validation {
namespace {

/// What may be seen in each pixel when one renderer draws.
class Expected {
 public:
  Expected(const LitScene& scene, const Drawn& drawn)
      : model_(drawn.model),
        width_(static_cast<int>(scene.camera.width)),
        touching_(std::size_t{scene.camera.width} * scene.camera.height) {
    for (const LitTriangle& t : scene.triangles) {
      triangles_.emplace_back(t, scene, drawn.precision);
      const auto [columns, rows] = triangles_.back().box();
      for (int y = rows[0]; y < rows[1]; ++y)
        for (int x = columns[0]; x < columns[1]; ++x)
          if (triangles_.back().coverage(x, y) != ExpectedTriangle::Coverage::none)
            at(x, y).push_back(static_cast<std::uint32_t>(triangles_.size() - 1));
    }
  }

  struct Pixel {
    std::vector<Codes> codes;  ///< of each triangle that may be seen
    bool background = true;    ///< it may be seen
  };

  [[nodiscard]] Pixel pixel(int x, int y) {
    Pixel pixel;
    double surely_seen = 0;
    for (const std::uint32_t i : at(x, y)) {
      if (triangles_[i].coverage(x, y) != ExpectedTriangle::Coverage::certain) continue;
      pixel.background = false;
      surely_seen = std::max(surely_seen, triangles_[i].inverse_depth(x, y).lower);
    }
    for (const std::uint32_t i : at(x, y))
      if (!(triangles_[i].inverse_depth(x, y).upper < surely_seen))
        pixel.codes.push_back(codes_of(triangles_[i].light(x, y, model_)));
    return pixel;
  }

 private:
  std::vector<std::uint32_t>& at(int x, int y) {
    return touching_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(x)];
  }

  LightModel model_;
  int width_;
  std::vector<ExpectedTriangle> triangles_;
  std::vector<std::vector<std::uint32_t>> touching_;
};

bool explains(const Expected::Pixel& pixel, int code) {
  if (pixel.background && code == 0) return true;
  return std::any_of(pixel.codes.begin(), pixel.codes.end(),
                     [&](const Codes& c) { return c.least <= code && code <= c.greatest; });
}

Codes all_of(const Expected::Pixel& pixel) {
  Codes all{pixel.background ? 0 : 255, 0};
  for (const Codes& c : pixel.codes)
    all = {std::min(all.least, c.least), std::max(all.greatest, c.greatest)};
  return all;
}

void count_inside(ColourComparison& found, const Codes& a, const Codes& b, int difference) {
  ++found.inside;
  found.equal += difference == 0;
  found.greatest_difference = std::max(found.greatest_difference, difference);
  const int bound = std::max(a.greatest - b.least, b.greatest - a.least);
  found.mean_bound += bound;
  found.within_one += bound <= 1;
  found.greatest_bound = std::max(found.greatest_bound, bound);
}

}  // namespace

ColourComparison compare_colours(const LitScene& scene, const Drawn& ours, const Drawn& theirs) {
  Expected of_ours(scene, ours), of_theirs(scene, theirs);
  ColourComparison found;
  const auto width = static_cast<int>(scene.camera.width),
             height = static_cast<int>(scene.camera.height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y) * scene.camera.width + static_cast<std::size_t>(x);
      const Expected::Pixel a = of_ours.pixel(x, y), b = of_theirs.pixel(x, y);
      const int mine = ours.picture->codes.at(i), other = theirs.picture->codes.at(i);
      if (!explains(a, mine) || !explains(b, other)) {
        found.unexplained.push_back({x, y, mine, other, all_of(a), all_of(b)});
      } else if (a.codes.empty() && b.codes.empty()) {
        ++found.background;
      } else if (a.codes.size() == 1 && b.codes.size() == 1 && !a.background && !b.background) {
        count_inside(found, a.codes[0], b.codes[0], std::abs(mine - other));
      } else {
        ++found.edge;
      }
    }
  }
  if (found.inside > 0) found.mean_bound /= static_cast<double>(found.inside);
  return found;
}

}  // namespace fathom::validation
