#include "fathom/area/deep_pixels.h"

#include <algorithm>
#include <tuple>

#include "fathom/area/coverage_image.h"
#include "fathom/area/image_cell.h"
#include "fathom/area/visible_fragments.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/threads.h"

namespace fathom::area {
using namespace triangle;

namespace {

/// The visible part of a triangle in a pixel.
struct Fragment {
  const SurfaceRegion* surface;
  Boundary boundary;
  Certified<double> approximate_area{0, 0};
};

/// The visible surfaces of a pixel, and the part of it that they leave uncovered.
struct PixelSurfaces {
  std::vector<Fragment> fragments;
  Boundary uncovered;
};

void append(Boundary& boundary, Boundary more) {
  if (boundary.empty()) {
    boundary = std::move(more);
  } else {
    boundary.insert(boundary.end(), more.begin(), more.end());
  }
}

/// The boundary of the visible part of a triangle, to which more segments may be added.
Boundary& boundary_in(std::vector<Fragment>& fragments, const SurfaceRegion& surface) {
  for (auto f = fragments.rbegin(); f != fragments.rend(); ++f) {
    if (f->surface == &surface) return f->boundary;
  }
  fragments.push_back({&surface, {}, {}});
  return fragments.back().boundary;
}

PixelSurfaces look_into(ImageCell& pixel, std::span<const SurfaceRegion* const> triangles) {
  CellVisibility visibility(pixel);
  if (triangles.size() > DivisionLimits{}.few) {
    visibility.add_visible(triangles);
  } else {
    for (const SurfaceRegion* t : triangles) visibility.add(*t);
  }
  visibility.drop_hidden();
  PixelSurfaces result;
  divide(std::move(visibility), [&](CellVisibility& part) {
    for (std::size_t piece = 0; piece < part.size(); ++piece) {
      Boundary boundary = part.visible(piece);
      if (boundary.empty()) continue;
      append(boundary_in(result.fragments, part.surface(piece)), std::move(boundary));
    }
    append(result.uncovered, part.uncovered());
  });
  for (Fragment& f : result.fragments) f.approximate_area = approximate_area(f.boundary);
  return result;
}

/// Rounds a positive number once, with the first of three computations that settles the rounding.
float rounded(const Certified<double>& approximate, const std::function<Enclosure()>& enclosed,
              const std::function<Ratio()>& exact) {
  if (const auto settled = settled_binary32(approximate)) return *settled;
  const auto [low, high] = enclosed();
  if (low.sign() == Sign::positive) {
    const float least = round_to_binary32(low);
    if (least == round_to_binary32(high)) return least;
  }
  return round_to_binary32(exact());
}

Ratio exact_sum(std::span<const Fragment> fragments) {
  std::vector<Ratio> areas;
  for (const Fragment& f : fragments) areas.push_back(exact_area(f.boundary));
  return sum_of(std::move(areas));
}

EnclosedSum enclosed_sum(std::span<const Fragment> fragments) {
  EnclosedSum sum;
  for (const Fragment& f : fragments) sum.add(enclosed_area(f.boundary));
  return sum;
}

/// Areas of fragments that lie behind each other, as enclosures that are computed on demand.
class AreasBehind {
 public:
  AreasBehind(std::span<const Fragment> fragments, const Boundary& uncovered)
      : fragments_(fragments), uncovered_(uncovered) {}

  [[nodiscard]] const EnclosedSum& of(std::size_t i) {
    find();
    return areas_[i];
  }
  /// The sum of the areas of fragment i, of all fragments behind it, and of the uncovered part.
  [[nodiscard]] const EnclosedSum& from(std::size_t i) {
    find();
    return sums_[i];
  }

 private:
  void find() {
    if (!areas_.empty()) return;
    EnclosedSum sum = enclosed_area(uncovered_);
    areas_.resize(fragments_.size());
    sums_.resize(fragments_.size());
    for (std::size_t i = fragments_.size(); i-- > 0;) {
      areas_[i] = enclosed_area(fragments_[i].boundary);
      sum.add(areas_[i]);
      sums_[i] = sum;
    }
  }

  std::span<const Fragment> fragments_;
  const Boundary& uncovered_;
  std::vector<EnclosedSum> areas_, sums_;
};

/// a / (1 − Σ of the fragments before it) = a / (a + rest), where the rest is the area covered by
/// fragments behind it or by none: a sum of positive numbers, in which nothing cancels.
float alpha(std::span<const Fragment> fragments, std::size_t i, const Boundary& uncovered,
            AreasBehind& enclosed) {
  const Fragment& f = fragments[i];
  const auto behind = fragments.subspan(i + 1);
  if (behind.empty() && uncovered.empty()) return 1;
  Certified<double> rest = approximate_area(uncovered);
  for (const Fragment& b : behind) rest = rest + b.approximate_area;
  const Certified<double> one{1, 0};
  return rounded(
      one / (one + rest / f.approximate_area),
      [&]() -> Enclosure {
        const Enclosure a = enclosed.of(i).get(), sum = enclosed.from(i).get();
        if (sum.low.sign() != Sign::positive) return {};
        return {quotient(a.low, sum.high), quotient(a.high, sum.low)};
      },
      [&] {
        return quotient(exact_area(f.boundary),
                        exact_sum(fragments.subspan(i)) + exact_area(uncovered));
      });
}

std::vector<DeepSample> deep_samples(ImageCell& pixel, PixelSurfaces surfaces) {
  std::vector<std::pair<DeepSample, std::size_t>> order;
  for (std::size_t i = 0; i < surfaces.fragments.size(); ++i) {
    const Fragment& f = surfaces.fragments[i];
    const auto [nearest, farthest] = CellDepths(pixel, *f.surface).extent(f.boundary);
    order.push_back({{nearest, farthest, f.surface->number, 0, 0}, i});
  }
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    const auto key = [](const DeepSample& s) { return std::tuple(s.Z, s.ZBack, s.id); };
    return key(a.first) < key(b.first);
  });
  std::vector<Fragment> sorted;
  sorted.reserve(order.size());
  for (const auto& entry : order) sorted.push_back(std::move(surfaces.fragments[entry.second]));
  AreasBehind enclosed(sorted, surfaces.uncovered);
  std::vector<DeepSample> samples;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    DeepSample sample = order[i].first;
    sample.area = rounded(
        sorted[i].approximate_area, [&] { return enclosed.of(i).get(); },
        [&] { return exact_area(sorted[i].boundary); });
    sample.A = alpha(sorted, i, surfaces.uncovered, enclosed);
    samples.push_back(sample);
  }
  return samples;
}

std::vector<MatteShare> shares(const PixelSurfaces& surfaces,
                               const std::function<std::uint32_t(std::uint32_t)>& matte_of) {
  std::vector<std::pair<std::uint32_t, std::vector<Fragment>>> mattes;
  for (const Fragment& f : surfaces.fragments) {
    const std::uint32_t id = matte_of(f.surface->number);
    auto found = std::find_if(mattes.begin(), mattes.end(),
                              [&](const auto& matte) { return matte.first == id; });
    if (found == mattes.end()) found = mattes.insert(found, {id, {}});
    found->second.push_back(f);
  }
  std::vector<MatteShare> result;
  for (const auto& [id, fragments] : mattes) {
    Certified<double> sum{0, 0};
    for (const Fragment& f : fragments) sum = sum + f.approximate_area;
    // A single matte that leaves no part uncovered covers the whole pixel.
    const bool all = mattes.size() == 1 && surfaces.uncovered.empty();
    const float coverage =
        all ? 1
            : rounded(
                  sum, [&fragments = fragments] { return enclosed_sum(fragments).get(); },
                  [&fragments = fragments] { return exact_sum(fragments); });
    result.push_back({id, coverage});
  }
  std::sort(result.begin(), result.end(), [](const MatteShare& a, const MatteShare& b) {
    return a.coverage != b.coverage ? a.coverage > b.coverage : a.id < b.id;
  });
  return result;
}

/// Calls `compute` for every pixel that triangles may cover; gathers the items of all pixels, pixel
/// by pixel, with the count of each pixel.
template <class Item, class Compute>
void gather(const CoverageFrame& frame, const RenderOptions& options, const RowShare& share,
            const std::function<void(double)>& progress, const Compute& compute,
            std::vector<std::uint32_t>& counts, std::vector<Item>& items) {
  const std::size_t width = frame.camera.width;
  counts.assign(width * frame.camera.height, 0);
  // A single thread computes a row, from left to right.
  std::vector<std::vector<Item>> rows(frame.camera.height);
  const auto visit = [&](std::uint32_t column, std::uint32_t row,
                         std::span<const SurfaceRegion* const> triangles) {
    ImageCell pixel(column, row);
    const std::vector<Item> found = compute(pixel, triangles);
    counts[row * width + column] = static_cast<std::uint32_t>(found.size());
    rows[row].insert(rows[row].end(), found.begin(), found.end());
  };
  Progress parts(progress, std::max(1U, share.bands(frame.camera.height)));
  with_threads(options.threads, [&] {
    for_each_pixel(
        frame, visit, [&] { parts.part_done(); }, share);
  });
  for (std::vector<Item>& row : rows) {
    items.insert(items.end(), row.begin(), row.end());
    row = std::vector<Item>();  // {} would keep its memory
  }
}

}  // namespace

DeepMap visible_in_pixels(const TriangleSource& triangles, const Camera& camera,
                          const RenderOptions& options, const RowShare& share,
                          const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  DeepMap map;
  map.description.width = camera.width;
  map.description.height = camera.height;
  const auto compute = [](ImageCell& pixel, std::span<const SurfaceRegion* const> surfaces) {
    return deep_samples(pixel, look_into(pixel, surfaces));
  };
  gather({triangles, camera, options.cull}, options, share, progress, compute, map.counts,
         map.samples);
  return map;
}

Mattes mattes_in_pixels(const TriangleSource& triangles, const Camera& camera,
                        const RenderOptions& options,
                        const std::function<std::uint32_t(std::uint32_t)>& matte_of,
                        const RowShare& share, const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  Mattes mattes;
  const auto compute = [&](ImageCell& pixel, std::span<const SurfaceRegion* const> surfaces) {
    return shares(look_into(pixel, surfaces), matte_of);
  };
  gather({triangles, camera, options.cull}, options, share, progress, compute, mattes.counts,
         mattes.shares);
  return mattes;
}

}  // namespace fathom::area
