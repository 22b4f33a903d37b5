#include "fathom/reference/reference.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "fathom/area/coverage_image.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/reference/ray_decisions.h"
#include "fathom/reference/view.h"
#include "fathom/rendering/map_background.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/channels.h"
#include "fathom/triangle/projected_triangle.h"

// How to read this file: start with render_reference() at the end. The image is divided into bands
// of rows. For each band, every triangle whose box meets it is tested at every sample of its box,
// in the order of the triangles' numbers, and the nearest is kept. If the camera bends rays, a
// sample is the exact direction of its ray, and some samples have no ray.
namespace fathom {
using namespace area;
using namespace reference;
using namespace rendering;
using namespace triangle;

namespace {

constexpr std::uint32_t rows_per_band = 16;

/// A triangle that can be visible, with the pixels where it can be.
struct Candidate {
  std::uint32_t number;
  std::uint32_t object;
  std::uint32_t triangle;  // within its object's mesh
  PixelBox box;
};

/// The data of the depth test about the nearest surface so far at a sample.
struct Nearest {
  const ProjectedTriangle* triangle = nullptr;
  Interval depth;  // contains D(s), or t along a ray
};

ProjectedTriangle project(const Scene& scene, const Camera& camera, const Candidate& c,
                          TierCounts& counts) {
  const Object& object = scene.objects[c.object];
  return triangle::project(world_corners(object, scene.meshes[object.mesh], c.triangle), c.number,
                           camera, counts);
}

/// An interval that contains D of `t` at s, or t along a ray.
Interval enclose_depth(const ProjectedTriangle& t, const Sample& s) {
  const Interval numerator = s.direction() ? enclose(t.volume) : s.enclose(t.depth_numerator);
  return quotient(numerator, s.enclose(t.weight));
}

/// Whether D of `a` at s, or t along a ray, is strictly less than D of `b`, exactly.
bool is_less_deep(const ProjectedTriangle& a, const ProjectedTriangle& b, const Sample& s) {
  if (!s.direction()) return depth_at(a, s.point()) < depth_at(b, s.point());
  return order_along(a, b, *s.direction()) == Sign::positive;
}

/// Whether D of `t` at s is strictly less than D of the nearest surface so far. Triangles are drawn
/// in the order of their numbers, so that among equals the lowest number remains.
bool is_nearer(const ProjectedTriangle& t, const Interval& depth, const Nearest& nearest,
               const Sample& s, TierCounts& counts) {
  if (depth.upper < nearest.depth.lower || depth.lower > nearest.depth.upper) {
    ++counts.interval;
    return depth.upper < nearest.depth.lower;
  }
  ++counts.exact;
  return is_less_deep(t, *nearest.triangle, s);
}

class Band {
 public:
  Band(const View& view, std::uint32_t first_row)
      : width_(view.camera.width),
        first_row_(first_row),
        last_row_(std::min(first_row + rows_per_band, view.camera.height) - 1),
        nearest_(static_cast<std::size_t>(width_) * (last_row_ - first_row_ + 1)) {
    if (!view.preimages) return;
    rays_.reserve(nearest_.size());
    for (std::uint32_t row = first_row_; row <= last_row_; ++row) {
      for (std::uint32_t column = 0; column < width_; ++column) {
        rays_.push_back(view.preimages->of_pixel(column, row));
      }
    }
  }

  [[nodiscard]] bool meets(const PixelBox& box) const {
    return box.first_row <= last_row_ && box.last_row >= first_row_;
  }

  /// Tests one triangle at every sample of its box; `t` must outlive the band.
  void draw(const ProjectedTriangle& t, const PixelBox& box, const Camera& camera,
            RenderStatistics& statistics) {
    const DepthRange range(t, camera);
    for (std::uint32_t row = std::max(box.first_row, first_row_);
         row <= std::min(box.last_row, last_row_); ++row) {
      for (std::uint32_t column = box.first_column; column <= box.last_column; ++column) {
        test(t, row, column, range, statistics);
      }
    }
  }

  /// Writes which samples have a ray, of a camera that bends rays.
  void write_valid(std::uint32_t* valid) const {
    const std::size_t first_pixel = static_cast<std::size_t>(first_row_) * width_;
    for (std::size_t i = 0; i < rays_.size(); ++i) valid[first_pixel + i] = rays_[i] ? 1 : 0;
  }

  /// Writes the visible surface at every pixel; stops at the first fault in row order.
  std::optional<EncodingFault> resolve(ChannelWriter& writer, RenderStatistics& statistics) const {
    for (std::uint32_t row = first_row_; row <= last_row_; ++row) {
      for (std::uint32_t column = 0; column < width_; ++column) {
        const Nearest& nearest = nearest_[index(row, column)];
        if (!nearest.triangle) continue;
        ++statistics.pixels_with_surface;
        const std::size_t pixel = static_cast<std::size_t>(row) * width_ + column;
        auto fault = rays_.empty()
                         ? writer.write(pixel, *nearest.triangle, centre_of_pixel(column, row))
                         : writer.write(pixel, *nearest.triangle, *rays_[index(row, column)]);
        if (fault) return fault;
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::size_t index(std::uint32_t row, std::uint32_t column) const {
    return static_cast<std::size_t>(row - first_row_) * width_ + column;
  }

  void test(const ProjectedTriangle& t, std::uint32_t row, std::uint32_t column,
            const DepthRange& range, RenderStatistics& statistics) {
    const std::size_t i = index(row, column);
    if (!rays_.empty() && !rays_[i]) return;
    const Sample s = rays_.empty() ? Sample(centre_of_pixel(column, row)) : Sample(*rays_[i]);
    ++statistics.samples_tested;
    if (!covers(t, s, statistics.edges)) return;
    if (!range.contains(s, statistics.range)) return;
    ++statistics.samples_covered;
    const Interval depth = enclose_depth(t, s);
    Nearest& nearest = nearest_[i];
    if (!nearest.triangle || is_nearer(t, depth, nearest, s, statistics.visibility)) {
      nearest = {&t, depth};
    }
  }

  std::uint32_t width_;
  std::uint32_t first_row_;
  std::uint32_t last_row_;
  std::vector<Nearest> nearest_;
  /// Of each sample; empty if the camera bends no rays.
  std::vector<std::optional<lens::ExactDirection>> rays_;
};

/// The candidates among the triangles of one object, in the order of their numbers.
std::vector<Candidate> find_candidates(const Scene& scene, const View& view, Cull cull,
                                       std::uint32_t object, std::uint32_t first_number,
                                       RenderStatistics& statistics) {
  constexpr std::uint32_t chunk = 4096;
  const auto count =
      static_cast<std::uint32_t>(scene.meshes[scene.objects[object].mesh].triangles.size());
  const std::uint32_t chunks = count / chunk + (count % chunk != 0);
  std::vector<std::vector<Candidate>> found(chunks);
  std::vector<RenderStatistics> parts(chunks);
  parallel_for(std::uint32_t{0}, chunks, [&](std::uint32_t k) {
    const std::uint32_t end = count - k * chunk < chunk ? count : (k + 1) * chunk;
    for (std::uint32_t i = k * chunk; i < end; ++i) {
      Candidate c{first_number + i, object, i, {}};
      const ProjectedTriangle t = project(scene, view.camera, c, parts[k].facing);
      if (t.orientation == Sign::zero) {
        ++parts[k].degenerate_triangles;
      } else if (!is_kept(t, cull)) {
        ++parts[k].culled_triangles;
      } else if (c.box = view.box_of(t); !c.box.is_empty()) {
        found[k].push_back(c);
      }
    }
  });
  std::vector<Candidate> all;
  for (std::uint32_t k = 0; k < chunks; ++k) {
    all.insert(all.end(), found[k].begin(), found[k].end());
    add(statistics, parts[k]);
  }
  return all;
}

std::vector<Candidate> find_candidates(const Scene& scene, const View& view, Cull cull,
                                       RenderStatistics& statistics) {
  std::vector<Candidate> all;
  std::uint32_t first_number = 0;
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    const auto found = find_candidates(scene, view, cull, object, first_number, statistics);
    all.insert(all.end(), found.begin(), found.end());
    first_number +=
        static_cast<std::uint32_t>(scene.meshes[scene.objects[object].mesh].triangles.size());
  }
  return all;
}

/// Renders one band: project, test, resolve.
std::optional<EncodingFault> render_band(const Scene& scene, const View& view,
                                         const std::vector<Candidate>& candidates,
                                         std::uint32_t first_row, ChannelWriter& writer,
                                         RenderStatistics& statistics) {
  Band band(view, first_row);
  if (std::uint32_t* const valid = writer.values().valid; valid && view.preimages) {
    band.write_valid(valid);
  }
  std::vector<std::unique_ptr<ProjectedTriangle>> projected;
  TierCounts counted_before;  // facing was counted when the candidates were found
  for (const Candidate& c : candidates) {
    if (!band.meets(c.box)) continue;
    projected.push_back(
        std::make_unique<ProjectedTriangle>(project(scene, view.camera, c, counted_before)));
    band.draw(*projected.back(), c.box, view.camera, statistics);
  }
  return band.resolve(writer, statistics);
}

Rendered render_in_arena(const Scene& scene, const Camera& camera, const RenderOptions& options,
                         const RenderContext& context, DepthMap before) {
  RenderStatistics statistics;
  statistics.triangles = triangle_count(scene);
  const View view(camera);
  const std::vector<Candidate> candidates = find_candidates(scene, view, options.cull, statistics);

  DepthMap map = make_background(camera, options, context, std::move(before));
  ChannelWriter writer(map, scene, camera, options);
  const std::uint32_t bands = (camera.height - 1) / rows_per_band + 1;
  std::vector<RenderStatistics> parts(bands);
  std::vector<std::optional<EncodingFault>> faults(bands);
  Progress progress(context.progress, bands);
  parallel_for(std::uint32_t{0}, bands, [&](std::uint32_t band) {
    faults[band] = render_band(scene, view, candidates, band * rows_per_band, writer, parts[band]);
    progress.part_done();
  });

  if (float* coverage = writer.values().coverage) {
    statistics.coverage += write_coverage({scene, camera, options.cull}, coverage);
  }
  for (std::uint32_t band = 0; band < bands; ++band) {
    if (faults[band]) fail(*faults[band], map);
    add(statistics, parts[band]);
  }
  return {std::move(map), statistics, {}};
}

}  // namespace

Rendered render_reference(const Scene& scene, const Camera& camera, const RenderOptions& options,
                          const RenderContext& context, DepthMap before) {
  const StandardArithmetic standard;
  require_meaningful(options);
  return with_threads(options.threads, [&] {
    require_renderable_by_rays(scene, camera);
    require_channels_of(camera, options);
    return render_in_arena(scene, camera, options, context, std::move(before));
  });
}

}  // namespace fathom
