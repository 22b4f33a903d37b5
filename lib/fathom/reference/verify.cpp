#include "fathom/reference/verify.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <limits>
#include <map>
#include <mutex>
#include <random>
#include <utility>

#include "fathom/area/coverage.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/reference/verify_samples.h"
#include "fathom/reference/view.h"
#include "fathom/rendering/map_background.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/channels.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/triangle_boxes.h"

// How to read this file: start with verify() at the end. It processes the chosen pixels in groups
// of consecutive rows. For each group, it finds the triangles whose exact box contains a chosen
// pixel, projects each exactly and tests it at these pixels. The writer of the reference engine
// writes the nearest triangles to a map of a single row, with a pixel for each chosen pixel. This
// row is compared with the map.
namespace fathom {
using namespace reference;
using namespace rendering;
using namespace triangle;

namespace {

constexpr std::size_t pixels_per_group = std::size_t{1} << 22;
constexpr std::uint32_t triangles_per_chunk = 4096;
constexpr std::uint32_t rows_per_band = 16;
constexpr std::uint32_t triangles_of_file = 1U << 19;

/// A triangle that may cover a chosen pixel.
struct Candidate {
  std::uint32_t number;
  PixelBox box;
};

/// The nearest triangle found so far at a chosen pixel.
struct Visible {
  const Candidate* triangle = nullptr;
  Ratio depth;
};

/// The data that all pixels share.
struct Frame {
  const DepthMap& map;
  const TriangleSource& triangles;
  const Camera& camera;
  const RenderOptions& options;
  const View& view;
};

ProjectedTriangle project(const Frame& frame, const Candidate& c) {
  TierCounts counts;
  return triangle::project(frame.triangles.world_corners(c.number), c.number, frame.camera, counts);
}

/// Boxes around the triangles of a part of the scene.
class PartBoxes {
 public:
  PartBoxes(const TriangleSource::Part& part, const View& view)
      : part_(part), view_(view), straight_(part.object, part.mesh, view.camera) {}

  /// A box that contains every chosen pixel whose sample the triangle covers.
  PixelBox box(std::uint32_t triangle) {
    if (!view_.groups) return straight_.box(triangle);
    TierCounts counts;
    const ProjectedTriangle t =
        triangle::project(world_corners(part_.object, part_.mesh, triangle),
                          part_.first_number + triangle, view_.camera, counts);
    return t.orientation == Sign::zero ? PixelBox() : view_.box_of(t);
  }

 private:
  const TriangleSource::Part& part_;
  const View& view_;
  TriangleBoxes straight_;
};

/// Adds the candidates of a part of the scene, in the order of their numbers.
void find_candidates(const TriangleSource::Part& part, const View& view, const ChosenRows& chosen,
                     std::vector<Candidate>& all) {
  const std::size_t count = part.mesh.triangles.size();
  std::vector<std::vector<Candidate>> found((count + triangles_per_chunk - 1) /
                                            triangles_per_chunk);
  parallel_for(std::size_t{0}, found.size(), [&](std::size_t k) {
    PartBoxes boxes(part, view);
    const std::size_t end = std::min(count, (k + 1) * triangles_per_chunk);
    for (std::size_t i = k * triangles_per_chunk; i < end; ++i) {
      const auto triangle = static_cast<std::uint32_t>(i);
      const PixelBox box = boxes.box(triangle);
      if (chosen.meet(box)) found[k].push_back({part.first_number + triangle, box});
    }
  });
  for (const auto& candidates : found) {
    all.insert(all.end(), candidates.begin(), candidates.end());
  }
}

std::vector<Candidate> find_candidates(const Frame& frame, const ChosenRows& chosen) {
  std::vector<Candidate> all;
  frame.triangles.for_each_part(triangles_of_file, [&](const TriangleSource::Part& part) {
    find_candidates(part, frame.view, chosen, all);
  });
  return all;
}

/// Consecutive rows of a group, the work of one thread.
struct Band {
  std::uint32_t first_row = 0, end_row = 0;
  /// In the order of their numbers.
  std::vector<const Candidate*> candidates;
};

std::vector<Band> cut_into_bands(const ChosenRows& chosen, const std::vector<Candidate>& all) {
  std::vector<Band> bands;
  for (std::uint32_t row = chosen.first_row(); row < chosen.end_row(); row += rows_per_band) {
    bands.push_back({row, std::min(row + rows_per_band, chosen.end_row()), {}});
  }
  for (const Candidate& c : all) {
    const std::uint32_t first = std::max(c.box.first_row, chosen.first_row());
    const std::uint32_t last = std::min(c.box.last_row, chosen.end_row() - 1);
    for (std::uint32_t band = (first - chosen.first_row()) / rows_per_band;
         band <= (last - chosen.first_row()) / rows_per_band; ++band) {
      bands[band].candidates.push_back(&c);
    }
  }
  return bands;
}

/// The recomputed pixels of a group: a map of a single row, with a pixel for each chosen pixel, and
/// the values that the encoding could not hold.
class ExactRow {
 public:
  ExactRow(const Frame& frame, const ChosenRows& chosen)
      : frame_(frame),
        chosen_(chosen),
        map_(make_background(row_camera(frame.camera, chosen.size()), frame.options)),
        writer_(map_, frame.triangles, frame.camera, frame.options) {}

  /// Several threads may compute different bands at the same time.
  void compute(const Band& band) {
    if (frame_.view.preimages) return compute_along_rays(band);
    const std::size_t first = chosen_.start(band.first_row);
    std::vector<Visible> visible(chosen_.start(band.end_row) - first);
    for (const Candidate* c : band.candidates) draw(*c, band, first, visible);
    write(band, first, visible);
    if (float* coverage = writer_.values().coverage) write_coverage(band, coverage);
  }

  [[nodiscard]] const DepthMap& map() const { return map_; }
  [[nodiscard]] const std::map<std::size_t, std::string>& faults() const { return faults_; }

 private:
  static Camera row_camera(Camera camera, std::size_t pixels) {
    camera.width = static_cast<std::uint32_t>(pixels);
    camera.height = 1;
    return camera;
  }

  void compute_along_rays(const Band& band) {
    ChosenRays rays(frame_.view, chosen_, band.first_row, band.end_row);
    for (const Candidate* c : band.candidates) {
      ProjectedTriangle t = project(frame_, *c);
      if (is_kept(t, frame_.options.cull)) rays.draw(std::move(t), c->box);
    }
    rays.write(writer_, [this](std::size_t k, const std::string& why) { note_fault(k, why); });
  }

  void note_fault(std::size_t k, const std::string& why) {
    const std::lock_guard lock(mutex_);
    faults_[k] = why;
  }

  void draw(const Candidate& c, const Band& band, std::size_t first,
            std::vector<Visible>& visible) const {
    std::optional<ProjectedTriangle> projected;
    TierCounts tiers;
    const std::uint32_t end = std::min(c.box.last_row + 1, band.end_row);
    for (std::uint32_t row = std::max(c.box.first_row, band.first_row); row < end; ++row) {
      const auto pixels = chosen_.within(row, c.box.first_column, c.box.last_column);
      for (std::size_t k = pixels.first; k < pixels.end; ++k) {
        if (!projected) projected = project(frame_, c);
        if (!is_kept(*projected, frame_.options.cull)) return;
        const ImagePoint s = centre_of_pixel(chosen_.column(k), row);
        if (!covers(*projected, s, tiers)) continue;
        Ratio depth = depth_at(*projected, s);
        if (!is_in_range(depth, frame_.camera)) continue;
        // Triangles are tested in the order of their numbers: among equals the lowest number
        // remains.
        Visible& nearest = visible[k - first];
        if (!nearest.triangle || depth < nearest.depth) nearest = {&c, std::move(depth)};
      }
    }
  }

  /// Each visible triangle is projected once for all pixels that show it.
  void write(const Band& band, std::size_t first, const std::vector<Visible>& visible) {
    std::map<const Candidate*, std::vector<std::pair<std::size_t, std::uint32_t>>> shown;
    for (std::uint32_t row = band.first_row; row < band.end_row; ++row) {
      for (std::size_t k = chosen_.start(row); k < chosen_.start(row + 1); ++k) {
        if (const Candidate* c = visible[k - first].triangle) shown[c].emplace_back(k, row);
      }
    }
    for (const auto& [candidate, pixels] : shown) {
      const ProjectedTriangle triangle = project(frame_, *candidate);
      for (const auto& [k, row] : pixels) {
        if (auto fault = writer_.write(k, triangle, centre_of_pixel(chosen_.column(k), row)))
          note_fault(k, fault->why);
      }
    }
  }

  void write_coverage(const Band& band, float* values) const {
    const CoverageFrame coverage{frame_.triangles, frame_.camera, frame_.options.cull};
    for (std::uint32_t row = band.first_row; row < band.end_row; ++row) {
      for (std::size_t k = chosen_.start(row); k < chosen_.start(row + 1); ++k) {
        const std::uint32_t column = chosen_.column(k);
        std::vector<std::uint32_t> near;
        for (const Candidate* c : band.candidates) {
          if (c->box.contains(column, row)) near.push_back(c->number);
        }
        values[k] = rounded_pixel_coverage(coverage, near, column, row);
      }
    }
  }

  const Frame& frame_;
  const ChosenRows& chosen_;
  DepthMap map_;
  ChannelWriter writer_;
  std::map<std::size_t, std::string> faults_;
  std::mutex mutex_;
};

template <class T>
std::string in_digits(T value) {
  if constexpr (std::is_floating_point_v<T>) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*g = %a", std::numeric_limits<T>::max_digits10,
                  static_cast<double>(value), static_cast<double>(value));
    return text;
  } else {
    return std::to_string(value);
  }
}

template <class T>
bool same_bits(T a, T b) {
  if constexpr (std::is_same_v<T, float>) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
  } else if constexpr (std::is_same_v<T, double>) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  } else {
    return a == b;
  }
}

std::string value_at(const ImageChannel& channel, std::size_t at) {
  return std::visit([&](const auto& values) { return in_digits(values[at]); }, channel.values);
}

/// If pixel `at` of a channel differs from pixel k of the exact channel, the values of both.
std::optional<std::pair<std::string, std::string>> difference(const ImageChannel& found,
                                                              std::size_t at,
                                                              const ImageChannel& exact,
                                                              std::size_t k) {
  return std::visit(
      [&](const auto& values) -> std::optional<std::pair<std::string, std::string>> {
        const auto& ours = std::get<std::decay_t<decltype(values)>>(found.values);
        if (same_bits(ours[at], values[k])) return std::nullopt;
        return std::pair(in_digits(ours[at]), in_digits(values[k]));
      },
      exact.values);
}

void compare(const Frame& frame, const ChosenRows& chosen, const ExactRow& exact,
             Verification& result) {
  for (std::uint32_t row = chosen.first_row(); row < chosen.end_row(); ++row) {
    for (std::size_t k = chosen.start(row); k < chosen.start(row + 1); ++k) {
      const std::size_t at = static_cast<std::size_t>(row) * frame.map.width + chosen.column(k);
      std::optional<Disagreement> here;
      for (const ImageChannel& channel : exact.map().channels) {
        const auto values = difference(*frame.map.find(channel.name), at, channel, k);
        if (!values) continue;
        here = {chosen.column(k), row, channel.name, values->first, values->second};
        break;
      }
      if (const auto fault = exact.faults().find(k); fault != exact.faults().end()) {
        const ImageChannel& channel = frame.map.channels.front();
        if (!here) here = {chosen.column(k), row, channel.name, value_at(channel, at), ""};
        here->expected = fault->second;
      }
      ++result.verified;
      if (!here) continue;
      ++result.differing;
      if (!result.first) result.first = std::move(here);
    }
  }
}

/// Refuses a map that lacks a channel of the options, or has it stored in another way.
void require_channels(const DepthMap& map, Camera camera, const RenderOptions& options) {
  camera.width = camera.height = 1;
  for (const ImageChannel& expected : make_background(camera, options).channels) {
    const ImageChannel* channel = map.find(expected.name);
    if (!channel) throw UsageError("the map has no channel '" + expected.name + "' to verify");
    if (channel->values.index() != expected.values.index()) {
      throw UsageError("channel '" + expected.name + "' of the map is stored in another way");
    }
  }
}

Verification verify_in_arena(const Frame& frame, const PixelChoice& chosen,
                             const std::function<void(double)>& progress) {
  Verification result;
  const Camera& camera = frame.camera;
  Progress bands_done(progress, (camera.height - 1) / rows_per_band + 1);
  for (std::uint32_t row = 0; row < camera.height;) {
    const ChosenRows rows(chosen, camera.width, camera.height, row, pixels_per_group);
    row = rows.end_row();
    if (rows.size() == 0) break;  // no pixel is chosen from here to the end of the image
    const std::vector<Candidate> candidates = find_candidates(frame, rows);
    const std::vector<Band> bands = cut_into_bands(rows, candidates);
    ExactRow exact(frame, rows);
    parallel_for(std::size_t{0}, bands.size(), [&](std::size_t band) {
      exact.compute(bands[band]);
      bands_done.part_done();
    });
    compare(frame, rows, exact, result);
  }
  return result;
}

}  // namespace

PixelChoice choose_pixels(std::uint32_t width, std::uint32_t height, std::uint64_t count) {
  const StandardArithmetic standard;
  const std::uint64_t pixels = std::uint64_t{width} * height;
  if (count >= pixels) return PixelChoice(pixels, true);
  PixelChoice chosen(pixels, false);
  std::mt19937_64 random(verification_seed);
  for (std::uint64_t last = pixels - count; last < pixels; ++last) {
    const std::uint64_t pixel = random() % (last + 1);
    chosen[chosen[pixel] ? last : pixel] = true;
  }
  return chosen;
}

Verification verify(const DepthMap& map, const TriangleSource& triangles, const Camera& camera,
                    const RenderOptions& options, const PixelChoice& chosen,
                    const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  require_meaningful(options);
  require_map_of(camera, map);
  require_channels(map, camera, options);
  if (chosen.size() != std::size_t{map.width} * map.height) {
    throw UsageError(Setting{"chosen"}, "expected one choice for each pixel of the map");
  }
  return with_threads(options.threads, [&] {
    require_renderable_by_rays(triangles, camera);
    require_channels_of(camera, options);
    const View view(camera, &chosen);
    return verify_in_arena({map, triangles, camera, options, view}, chosen, progress);
  });
}

}  // namespace fathom
