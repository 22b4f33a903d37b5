#include "fathom/pipeline/rasterization/rasterizer.h"

#include <algorithm>

#include "fathom/pipeline/scan/area_fill.h"
#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

constexpr std::int64_t block_size = 8;

template <class Real>
class Rasterizer {
 public:
  Rasterizer(const RasterizerSettings& settings, Shader<Real>* shader, FrameBuffer& target,
             PipelineStatistics& statistics)
      : s_(settings),
        merger_(s_.options, s_.depth_tested, target, statistics, s_.observe),
        shader_(shader),
        count_(statistics) {}

  void draw(const WindowTriangle<Real>& triangle) {
    check_interruption();
    const auto interpolator = Interpolator<Real>::of(triangle, s_.options);
    if (!interpolator) return;
    if (shader_) shader_->begin(triangle);
    merger_.begin(s_.rules[triangle.object]);
    if (s_.options.scan == ScanConversion::scan_line) {
      draw_by_scan_lines(*interpolator);
    } else {
      draw_by_edge_functions(*interpolator);
    }
  }

 private:
  void draw_by_edge_functions(const Interpolator<Real>& t) {
    const PixelWindow box = overlap(t.grid().bounding_box(), s_.window);
    if (box.is_empty()) return;
    if (!s_.options.blocks) {
      draw_part(t, box, false);
      return;
    }
    const auto start = [](std::int64_t x) {
      return x - (x % block_size + block_size) % block_size;
    };
    for (std::int64_t y = start(box.y_begin); y < box.y_end; y += block_size) {
      check_interruption();
      for (std::int64_t x = start(box.x_begin); x < box.x_end; x += block_size) {
        const auto coverage = t.grid().test_block({x, y}, block_size);
        const bool full = coverage == GridTriangle::BlockCoverage::all;
        count_.blocks_full += full;
        if (coverage == GridTriangle::BlockCoverage::none) {
          ++count_.blocks_skipped;
        } else {
          draw_part(t, overlap(box, {x, y, x + block_size, y + block_size}), full);
        }
      }
    }
  }

  /// `full`: every sample is covered.
  void draw_part(const Interpolator<Real>& t, const PixelWindow& part, bool full) {
    for (std::int64_t y = part.y_begin; y < part.y_end; ++y) {
      check_interruption();
      for (std::int64_t x = part.x_begin; x < part.x_end; ++x) {
        if (s_.rate == ShadingRate::per_pixel) {
          draw_pixel(t, {x, y}, full);
        } else {
          for (std::size_t i = 0; i < s_.pattern.size(); ++i) {
            const GridPoint sample = sample_at({x, y}, i);
            if (full || t.grid().covers(sample)) draw_sample(t, {x, y}, i, sample);
          }
        }
      }
    }
  }

  [[nodiscard]] GridPoint sample_at(const Pixel& p, std::size_t i) const {
    const GridPoint offset = s_.pattern.at(p, i);
    return sample_of(p, offset.x, offset.y);
  }

  Colour shade(const Interpolator<Real>& t, const GridPoint& sample) {
    if (!shader_) return {};
    ++count_.shaded;
    Fragment fragment;
    t.complete(fragment, sample);
    return shader_->shade(fragment, t.attribute_weights(sample));
  }

  void draw_sample(const Interpolator<Real>& t, const Pixel& p, std::size_t i,
                   const GridPoint& sample) {
    ++count_.fragments;
    const Fragment fragment = t.depths_at(sample);
    const StoredDepth stored = merger_.stored(fragment);
    const Outcome outcome = merger_.test(p, i, stored);
    if (s_.options.early_depth && !merger_.is_wanted(outcome)) return;
    merger_.merge(p, i, {t.triangle().number, stored, fragment.depth, fragment.window_z},
                  shade(t, sample), outcome);
  }

  void draw_pixel(const Interpolator<Real>& t, const Pixel& p, bool full) {
    covered_.clear();
    GridPoint sum;
    for (std::size_t i = 0; i < s_.pattern.size(); ++i) {
      const GridPoint sample = sample_at(p, i);
      if (!full && !t.grid().covers(sample)) continue;
      covered_.push_back(i);
      sum = {sum.x + sample.x, sum.y + sample.y};
    }
    if (covered_.empty()) return;
    ++count_.fragments;
    const auto n = static_cast<std::int64_t>(covered_.size());
    const GridPoint centre = sample_of(p);
    const GridPoint place =
        full || t.grid().covers(centre) ? centre : GridPoint{sum.x / n, sum.y / n};
    bool shaded = false;
    Colour colour{};
    for (const std::size_t i : covered_) {
      const Fragment fragment = t.depths_at(sample_at(p, i));
      const StoredDepth stored = merger_.stored(fragment);
      const Outcome outcome = merger_.test(p, i, stored);
      if (!merger_.is_wanted(outcome)) continue;
      if (!shaded) colour = shade(t, place);
      shaded = true;
      merger_.merge(p, i, {t.triangle().number, stored, fragment.depth, fragment.window_z}, colour,
                    outcome);
    }
  }

  /// Two-step interpolation of z, 1/w and attributes over w, in the pipeline's arithmetic.
  void draw_by_scan_lines(const Interpolator<Real>& t) {
    const bool perspective = s_.options.interpolation == Interpolation::perspective;
    FillPolygon<Real> polygon(1);
    const auto corners = snapped(t.triangle(), s_.options.subpixel_bits);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& c = t.triangle().corners[k];
      const auto one = static_cast<Real>(grid_one);
      FillCorner<Real> corner{static_cast<Real>(corners[k].x) / one,
                              static_cast<Real>(corners[k].y) / one,
                              {c.z, c.inverse_w}};
      corner.attributes.push_back(c.attributes[attribute::depth] * c.inverse_w);
      for (std::size_t i = 0; i < attribute::of_fragments; ++i)
        corner.attributes.push_back(perspective ? c.attributes[i] * c.inverse_w : c.attributes[i]);
      polygon[0].push_back(std::move(corner));
    }
    fill_polygon<Real>(polygon, FillRule::even_odd, s_.window, [&](const ScanLine<Real>& line) {
      for (const auto& span : line.spans) {
        const auto values = values_along(span);
        for (std::size_t i = 0; i < values.size(); ++i)
          draw_value(t, {span.pixels.x_begin + static_cast<std::int64_t>(i), line.y}, values[i],
                     perspective);
      }
    });
  }

  void draw_value(const Interpolator<Real>& t, const Pixel& p, const std::vector<Real>& v,
                  bool perspective) {
    ++count_.fragments;
    Fragment fragment;
    fragment.window_z = std::clamp(static_cast<double>(v[0] + t.triangle().depth_offset), 0.0, 1.0);
    fragment.depth = static_cast<double>(v[2] / v[1]);
    const StoredDepth stored = merger_.stored(fragment);
    const Outcome outcome = merger_.test(p, 0, stored);
    if (s_.options.early_depth && !merger_.is_wanted(outcome)) return;
    Colour colour{};
    if (shader_) {
      ++count_.shaded;
      t.complete(fragment, sample_of(p));  // changes of texture coordinates
      for (std::size_t i = 0; i < attribute::of_fragments; ++i)
        fragment.attributes[i] = static_cast<double>(perspective ? v[3 + i] / v[1] : v[3 + i]);
      colour = shader_->shade(fragment, t.attribute_weights(sample_of(p)));
    }
    merger_.merge(p, 0, {t.triangle().number, stored, fragment.depth, fragment.window_z}, colour,
                  outcome);
  }

  const RasterizerSettings& s_;
  OutputMerger merger_;
  Shader<Real>* shader_;
  PipelineStatistics& count_;
  std::vector<std::size_t> covered_;
};

}  // namespace

template <class Real>
void rasterize(const std::vector<WindowTriangle<Real>>& triangles,
               const RasterizerSettings& settings, Shader<Real>* shader, FrameBuffer& target,
               PipelineStatistics& statistics) {
  Rasterizer<Real> rasterizer(settings, shader, target, statistics);
  for (const WindowTriangle<Real>& triangle : triangles) rasterizer.draw(triangle);
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Real)                                                               \
  template void rasterize(const std::vector<WindowTriangle<Real>>&, const RasterizerSettings&, \
                          Shader<Real>*, FrameBuffer&, PipelineStatistics&);
FATHOM_INSTANTIATE(float)
FATHOM_INSTANTIATE(double)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
