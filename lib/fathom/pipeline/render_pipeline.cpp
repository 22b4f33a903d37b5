#include "fathom/pipeline/render_pipeline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/pipeline/geometry/geometry_stages.h"
#include "fathom/pipeline/geometry/window_triangle.h"
#include "fathom/pipeline/output/area_sampling.h"
#include "fathom/pipeline/output/fxaa.h"
#include "fathom/pipeline/rasterization/rasterizer.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

template <class Real>
class Frame {
 public:
  Frame(const Scene& scene, const Camera& camera, const PipelineOptions& options)
      : scene_(scene),
        camera_(camera),
        options_(options),
        rules_(draw_rules_of(scene, options)),
        window_(drawable_window(camera, options)) {}

  PipelineFrame run(bool with_picture) {
    prepare(nullptr);
    frame_.statistics.near = options_.depth_format.near;
    frame_.statistics.far = options_.depth_format.far;
    // Also if no picture is requested, so that an unusable texture is reported.
    Shader<Real> shader(camera_, options_, texture_of(scene_, options_));
    const bool same_samples = options_.antialias.method == AntialiasMethod::none ||
                              options_.antialias.method == AntialiasMethod::fxaa;
    FrameBuffer centres = buffer(1);
    // The map first: without colours, unless its samples are the picture's.
    PipelineStatistics uncounted;
    draw(GridSamples::centre(), with_picture && same_samples ? &shader : nullptr, centres,
         !with_picture || same_samples ? frame_.statistics : uncounted, window_);
    take_map(centres);
    if (!with_picture) return std::move(frame_);
    frame_.picture = same_samples ? centres.resolve() : antialiased(shader);
    if (options_.antialias.method == AntialiasMethod::fxaa)
      frame_.picture = fxaa(frame_.picture, options_.antialias.fxaa);
    return std::move(frame_);
  }

  FrameWatch watch(const std::optional<Pixel>& pixel) {
    FrameWatch watch;
    prepare(&watch.painter);
    if (!pixel || !window_.contains(*pixel)) return watch;
    options_.early_depth = false;  // fragments that fail are reported, too
    Shader<Real> shader(camera_, options_, texture_of(scene_, options_));
    FrameBuffer row{camera_.width, 1, 1, options_.background, static_cast<std::uint32_t>(pixel->y),
                    cleared()};
    const ObserveMerge observe = [&](const MergeStep& step) { watch.merger.push_back(step); };
    draw(GridSamples::centre(), &shader, row, frame_.statistics,
         {pixel->x, pixel->y, pixel->x + 1, pixel->y + 1}, ShadingRate::per_sample, &observe);
    return watch;
  }

 private:
  /// All stages up to the window, and the order in which triangles are drawn.
  void prepare(PainterTrace* trace) {
    primitives_ = to_window<Real>(scene_, camera_, options_, rules_, frame_.statistics);
    std::vector<WindowTriangle<Real>>& triangles = primitives_.triangles;
    put_into_draw_order(triangles, options_);
    if (options_.hidden_surface != HiddenSurface::painter) return;
    const DepthTest test(options_);
    triangles =
        painters_order(std::move(triangles), test.is_nearer({1}, {0}), frame_.painter, trace);
  }

  [[nodiscard]] FrameBuffer buffer(std::size_t samples) const {
    return {camera_.width, camera_.height, samples, options_.background, 0, cleared()};
  }

  /// The farthest depth that can be stored.
  [[nodiscard]] StoredDepth cleared() const {
    const StoredDepth greatest = greatest_stored(options_.depth_format.storage);
    return DepthTest(options_).is_nearer(greatest, {}) ? StoredDepth() : greatest;
  }

  void draw(const GridSamples& pattern, Shader<Real>* shader, FrameBuffer& target,
            PipelineStatistics& statistics, const PixelWindow& window,
            ShadingRate rate = ShadingRate::per_sample, const ObserveMerge* observe = nullptr,
            bool outlines_have_area = false) {
    const RasterizerSettings settings{options_,
                                      rules_,
                                      pattern,
                                      rate,
                                      options_.hidden_surface == HiddenSurface::z_buffer,
                                      window,
                                      observe,
                                      outlines_have_area};
    if (options_.shading != Shading::wireframe && options_.shading != Shading::points)
      rasterize(primitives_.triangles, settings, shader, target, statistics);
    rasterize_lines(primitives_.lines, settings, target, statistics);
    rasterize_points(primitives_.points, settings, target, statistics);
  }

  void take_map(const FrameBuffer& centres) {
    const std::size_t pixels = std::size_t{centres.width()} * centres.height();
    frame_.depth = Samples<float>(pixels);
    frame_.id = Samples<std::uint32_t>(pixels);
    frame_.stored.resize(pixels);
    frame_.depth_written.resize(pixels);
    frame_.stencil.resize(pixels);
    for (std::uint32_t y = 0; y < centres.height(); ++y) {
      check_interruption();
      for (std::uint32_t x = 0; x < centres.width(); ++x) {
        const StoredSample& s = centres.at({x, y}, 0);
        const std::size_t i = std::size_t{y} * centres.width() + x;
        frame_.id[i] = s.id;
        frame_.depth[i] = s.id == no_surface ? std::numeric_limits<float>::infinity()
                                             : static_cast<float>(s.depth);
        frame_.stored[i] = s.stored;
        frame_.depth_written[i] = s.depth_written;
        frame_.stencil[i] = s.stencil;
      }
    }
  }

  ColourImage antialiased(Shader<Real>& shader) {
    const int n = options_.antialias.count;
    switch (options_.antialias.method) {
      case AntialiasMethod::ssaa:
        return sampled(GridSamples::regular(n), shader, ShadingRate::per_sample);
      case AntialiasMethod::msaa:
        return sampled(multisamples(), shader, ShadingRate::per_pixel);
      case AntialiasMethod::jitter:
        return sampled(jittered_samples(), shader, ShadingRate::per_sample);
      case AntialiasMethod::taa:
        return temporal(shader, n);
      default:
        return area_sampled(primitives_.triangles, camera_, options_, window_, shader,
                            frame_.statistics);
    }
  }

  [[nodiscard]] GridSamples multisamples() const {
    const Antialias& a = options_.antialias;
    return GridSamples::of(
        sample_pattern(a.rotated_grid ? "rotated-grid" : std::to_string(a.count)));
  }

  [[nodiscard]] GridSamples jittered_samples() const {
    const auto side = std::lround(std::sqrt(options_.antialias.count));
    return GridSamples::of(sample_pattern("jittered:" + std::to_string(side)));
  }

  /// Works in strips, so that many samples per pixel need no more memory than few.
  ColourImage sampled(const GridSamples& pattern, Shader<Real>& shader, ShadingRate rate) {
    constexpr std::size_t most_samples = std::size_t{1} << 22;
    const auto rows = static_cast<std::uint32_t>(std::clamp<std::size_t>(
        most_samples / (pattern.size() * camera_.width), 1, camera_.height));
    ColourImage image{camera_.width, camera_.height, {}};
    for (std::uint32_t y = 0; y < camera_.height; y += rows) {
      const std::uint32_t height = std::min(rows, camera_.height - y);
      FrameBuffer strip{camera_.width, height, pattern.size(), options_.background, y, cleared()};
      PixelWindow window = window_;
      window.y_begin = std::max<std::int64_t>(window.y_begin, y);
      window.y_end = std::min<std::int64_t>(window.y_end, std::int64_t{y} + height);
      if (!window.is_empty())
        draw(pattern, &shader, strip, frame_.statistics, window, rate, nullptr, true);
      const ColourImage part = strip.resolve();
      image.pixels.insert(image.pixels.end(), part.pixels.begin(), part.pixels.end());
    }
    return image;
  }

  /// Each frame samples another place in the pixel. The history adds it with the weight that makes
  /// the result the mean of all frames, which is right for a camera at rest.
  ColourImage temporal(Shader<Real>& shader, int frames) {
    ColourImage history;
    for (int k = 0; k < frames; ++k) {
      const ColourImage frame = sampled(GridSamples::halton(k), shader, ShadingRate::per_sample);
      if (k == 0) {
        history = frame;
        continue;
      }
      const double weight = 1.0 / (k + 1);
      for (std::size_t i = 0; i < frame.pixels.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
          history.pixels[i][c] += weight * (frame.pixels[i][c] - history.pixels[i][c]);
    }
    return history;
  }

  const Scene& scene_;
  const Camera& camera_;
  PipelineOptions options_;
  std::vector<DrawRules> rules_;
  PixelWindow window_;
  WindowPrimitives<Real> primitives_;
  PipelineFrame frame_;
};

void require_countable(const Scene& scene) {
  std::uint64_t count = triangle_count(scene);
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    count += mesh.lines.size() + mesh.points.size();
    if (count >= no_surface)
      throw InputError("the scene has more than 4294967294 triangles, lines and points");
  }
}

/// Refuses lines and points where only areas are drawn.
void require_areas(const Scene& scene, const PipelineOptions& options) {
  if (!has_lines_or_points(scene)) return;
  const char* why = "draws areas only, but the scene has lines or points; choose another value";
  if (options.hidden_surface == HiddenSurface::painter)
    throw UsageError(Setting{"hidden_surface"}, std::string("painter ") + why);
  if (options.antialias.method == AntialiasMethod::area)
    throw UsageError(Setting{"antialias"}, std::string("area ") + why);
}

/// The options with the clip range of this view.
/// Fails    as render_frame() where scene, camera and options do not go together.
PipelineOptions completed(const Scene& scene, const Camera& camera,
                          const PipelineOptions& options) {
  require_renderable(scene, camera);
  PipelineOptions complete = options;
  fill_in_range(scene, camera, complete.depth_format);
  require_meaningful(complete.depth_format);
  require_countable(scene);
  require_areas(scene, complete);
  return complete;
}

}  // namespace

PipelineFrame render_frame(const Scene& scene, const Camera& camera, const PipelineOptions& options,
                           bool with_picture) {
  const StandardArithmetic standard;
  require_meaningful(options);
  if (options.antialias.method == AntialiasMethod::temporal ||
      options.antialias.method == AntialiasMethod::temporal_area)
    throw UsageError(Setting{"antialias"}, "temporal and temporal-area are for scenes that move");
  const PipelineOptions complete = completed(scene, camera, options);
  if (complete.precision == Precision::binary32)
    return Frame<float>(scene, camera, complete).run(with_picture);
  return Frame<double>(scene, camera, complete).run(with_picture);
}

FrameWatch watch_frame(const Scene& scene, const Camera& camera, const PipelineOptions& options,
                       const std::optional<Pixel>& pixel) {
  const StandardArithmetic standard;
  require_meaningful(options);
  const PipelineOptions complete = completed(scene, camera, options);
  if (complete.precision == Precision::binary32)
    return Frame<float>(scene, camera, complete).watch(pixel);
  return Frame<double>(scene, camera, complete).watch(pixel);
}

}  // namespace fathom::pipeline
