#include "fathom/reference/reference.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "fathom/area/coverage_image.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rendering/map_of_camera.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/channels.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/sampling.h"

// How to read this file: render_reference() at the end is the whole story. The image is cut into
// bands of rows. For each band, every triangle whose box meets it is tested at every sample of its
// box, in the order of the triangles' numbers, and the nearest is kept.
namespace fathom {
using namespace area;
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

/// What the depth test knows about the nearest surface so far at a sample.
struct Nearest {
  const ProjectedTriangle* triangle = nullptr;
  Interval depth;  // contains D(s)
};

ProjectedTriangle project(const Scene& scene, const Camera& camera, const Candidate& c,
                          TierCounts& counts) {
  const Object& object = scene.objects[c.object];
  return triangle::project(world_corners(object, scene.meshes[object.mesh], c.triangle), c.number,
                           camera, counts);
}

/// D > 0 and near ≤ D ≤ far (specification, section 5) as signs of forms on the image, for one
/// triangle: D = n / w with w > 0 at covered samples, so D ≥ near ⇔ n − near·w ≥ 0.
class DepthRange {
 public:
  DepthRange(const ProjectedTriangle& t, const Camera& camera) : depth_(t.depth_numerator) {
    if (camera.near > 0) above_near_ = minus(t.depth_numerator, camera.near, t.weight);
    if (camera.far < std::numeric_limits<double>::infinity()) {
      above_far_ = minus(t.depth_numerator, camera.far, t.weight);
    }
  }

  bool contains(const ImagePoint& s, TierCounts& counts) const {
    if (depth_.sign_at(s.u, s.v, counts) != Sign::positive) return false;
    if (above_near_ && above_near_->sign_at(s.u, s.v, counts) == Sign::negative) return false;
    return !above_far_ || above_far_->sign_at(s.u, s.v, counts) != Sign::positive;
  }

 private:
  /// n − limit·w. area/ has the same text; this one is the reference's own, as it decides the range
  /// of depths for itself.
  static ImageForm minus(const ImageForm& n, const Dyadic& limit, const ImageForm& w) {
    ExactVector3 l;
    for (std::size_t k = 0; k < 3; ++k) l[k] = n.coefficients()[k] - limit * w.coefficients()[k];
    return ImageForm(l);
  }

  const ImageForm& depth_;
  std::optional<ImageForm> above_near_, above_far_;
};

/// Whether D of `t` at s is strictly less than D of the nearest surface so far. Triangles come in
/// the order of their numbers, so that among equals the lowest number stays.
bool is_nearer(const ProjectedTriangle& t, const Interval& depth, const Nearest& nearest,
               const ImagePoint& s, TierCounts& counts) {
  if (depth.upper < nearest.depth.lower || depth.lower > nearest.depth.upper) {
    ++counts.interval;
    return depth.upper < nearest.depth.lower;
  }
  ++counts.exact;
  return depth_at(t, s) < depth_at(*nearest.triangle, s);
}

class Band {
 public:
  Band(const Camera& camera, std::uint32_t first_row)
      : width_(camera.width),
        first_row_(first_row),
        last_row_(std::min(first_row + rows_per_band, camera.height) - 1),
        nearest_(static_cast<std::size_t>(width_) * (last_row_ - first_row_ + 1)) {}

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

  /// Writes the visible surface at every pixel; stops at the first fault in row order.
  std::optional<EncodingFault> resolve(ChannelWriter& writer, RenderStatistics& statistics) const {
    for (std::uint32_t row = first_row_; row <= last_row_; ++row) {
      for (std::uint32_t column = 0; column < width_; ++column) {
        const Nearest& nearest = nearest_[index(row, column)];
        if (!nearest.triangle) continue;
        ++statistics.pixels_with_surface;
        const std::size_t pixel = static_cast<std::size_t>(row) * width_ + column;
        if (auto fault = writer.write(pixel, *nearest.triangle, centre_of_pixel(column, row))) {
          return fault;
        }
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
    const ImagePoint s = centre_of_pixel(column, row);
    ++statistics.samples_tested;
    if (!covers(t, s, statistics.edges)) return;
    if (!range.contains(s, statistics.range)) return;
    ++statistics.samples_covered;
    const Interval depth =
        quotient(t.depth_numerator.enclose_at(s.u, s.v), t.weight.enclose_at(s.u, s.v));
    Nearest& nearest = nearest_[index(row, column)];
    if (!nearest.triangle || is_nearer(t, depth, nearest, s, statistics.visibility)) {
      nearest = {&t, depth};
    }
  }

  std::uint32_t width_;
  std::uint32_t first_row_;
  std::uint32_t last_row_;
  std::vector<Nearest> nearest_;
};

/// The candidates among the triangles of one object, in the order of their numbers.
std::vector<Candidate> find_candidates(const Scene& scene, const Camera& camera, Cull cull,
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
      const ProjectedTriangle t = project(scene, camera, c, parts[k].facing);
      if (t.orientation == Sign::zero) {
        ++parts[k].degenerate_triangles;
      } else if (!is_kept(t, cull)) {
        ++parts[k].culled_triangles;
      } else if (c.box = bounding_box(t, camera); !c.box.is_empty()) {
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

std::vector<Candidate> find_candidates(const Scene& scene, const Camera& camera, Cull cull,
                                       RenderStatistics& statistics) {
  std::vector<Candidate> all;
  std::uint32_t first_number = 0;
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    const auto found = find_candidates(scene, camera, cull, object, first_number, statistics);
    all.insert(all.end(), found.begin(), found.end());
    first_number +=
        static_cast<std::uint32_t>(scene.meshes[scene.objects[object].mesh].triangles.size());
  }
  return all;
}

/// Renders one band: project, test, resolve.
std::optional<EncodingFault> render_band(const Scene& scene, const Camera& camera,
                                         const std::vector<Candidate>& candidates,
                                         std::uint32_t first_row, ChannelWriter& writer,
                                         RenderStatistics& statistics) {
  Band band(camera, first_row);
  std::vector<std::unique_ptr<ProjectedTriangle>> projected;
  TierCounts counted_before;  // facing was counted when the candidates were found
  for (const Candidate& c : candidates) {
    if (!band.meets(c.box)) continue;
    projected.push_back(
        std::make_unique<ProjectedTriangle>(project(scene, camera, c, counted_before)));
    band.draw(*projected.back(), c.box, camera, statistics);
  }
  return band.resolve(writer, statistics);
}

Rendered render_in_arena(const Scene& scene, const Camera& camera, const RenderOptions& options,
                         const RenderContext& context, DepthMap before) {
  RenderStatistics statistics;
  statistics.triangles = triangle_count(scene);
  const std::vector<Candidate> candidates =
      find_candidates(scene, camera, options.cull, statistics);

  DepthMap map = make_background(camera, options, context, std::move(before));
  ChannelWriter writer(map, scene, camera, options);
  const std::uint32_t bands = (camera.height - 1) / rows_per_band + 1;
  std::vector<RenderStatistics> parts(bands);
  std::vector<std::optional<EncodingFault>> faults(bands);
  Progress progress(context.progress, bands);
  parallel_for(std::uint32_t{0}, bands, [&](std::uint32_t band) {
    faults[band] =
        render_band(scene, camera, candidates, band * rows_per_band, writer, parts[band]);
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
    require_renderable(scene, camera);
    return render_in_arena(scene, camera, options, context, std::move(before));
  });
}

}  // namespace fathom
