#include "apps/doctor/data_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fathom/attribution/other_map.h"
#include "fathom/attribution/robust_statistics.h"
#include "fathom/failures/errors.h"
#include "fathom/render.h"

namespace fathom::doctor {
namespace {

using attribution::median_of;

constexpr double greatest_code = 65535;
constexpr float no_value = std::numeric_limits<float>::infinity();
/// Blocks of an image, in each direction.
constexpr std::uint32_t blocks_across = 4;
/// Of 8 images, enough for the best hypotheses of a search and the small changes of one; at most
/// half a MB each.
constexpr std::size_t kept_grids = 256;

/// The camera whose pixels are those of `camera` at a grid: the same samples.
Camera camera_of_grid(const Camera& camera, const Grid& grid) {
  Camera sampled = camera;
  Projection& p = sampled.projection;
  if (grid.stride == 1) return sampled;
  const double k = grid.stride;
  p.fx /= k;
  p.fy /= k;
  p.skew /= k;
  p.cx = (p.cx - grid.first - p.pixel_centre) / k + p.pixel_centre;
  p.cy = (p.cy - grid.first - p.pixel_centre) / k + p.pixel_centre;
  sampled.width = grid.width;
  sampled.height = grid.height;
  return sampled;
}

Grid grid_of(const Camera& camera, std::size_t pixels) {
  Grid grid{.camera = camera};
  const bool is_table = camera.projection.lens && camera.projection.lens->directions;
  const double share = double(camera.width) * camera.height / double(pixels);
  if (!is_table && share > 1) grid.stride = std::uint32_t(std::sqrt(share));
  grid.stride = std::min({grid.stride, camera.width, camera.height});
  grid.first = (grid.stride - 1) / 2;
  grid.width = camera.width / grid.stride;
  grid.height = camera.height / grid.stride;
  return grid;
}

std::vector<float> values_of(const DepthMap& map, const char* channel) {
  const Samples<float>& values = *map.values<float>(channel);
  return {values.begin(), values.end()};
}

}  // namespace

std::optional<double> DepthImage::at(const std::array<std::int64_t, 2>& place) const {
  const auto [column, row] = place;
  if (column < 0 || row < 0 || column >= size.width || row >= size.height) return std::nullopt;
  return depths[std::size_t(row) * size.width + std::size_t(column)];
}

DepthImage depth_image(DepthMap map, const std::string& file, double png_scale) {
  const bool has_codes = std::ranges::any_of(map.channels, [](const ImageChannel& channel) {
    return std::holds_alternative<Samples<std::uint16_t>>(channel.values);
  });
  if (has_codes) map.png_scale = png_scale;
  attribution::OtherMap other = attribution::other_map(map);
  DepthImage image{.file = file,
                   .size = {other.width, other.height},
                   .depths = std::move(other.depths),
                   .code_scale = other.code_scale};
  image.is_zero_none = true;
  for (std::size_t i = 0; i < other.values.size(); ++i) {
    if (other.values[i] == 0) ++image.zeros;
    const bool has_value = std::isfinite(image.depths[i]) && image.depths[i] > 0;
    if (!has_value) image.depths[i] = std::numeric_limits<double>::infinity();
    if (!has_value && other.values[i] != 0) image.is_zero_none = false;
  }
  return image;
}

void require_depths(const std::vector<View>& views) {
  const bool has_depths = std::ranges::any_of(views, [](const View& view) {
    return std::ranges::any_of(view.image.depths, [](double d) { return std::isfinite(d); });
  });
  if (!has_depths)
    throw InputError(views.front().image.file + ": no pixel has a depth, expected depth images");
}

std::optional<Ceiling> ceiling_of(const std::vector<View>& views) {
  double greatest = 0;
  std::uint64_t valid = 0, count = 0;
  bool is_code = false;
  for (const View& view : views) {
    const double last = view.image.code_scale ? greatest_code / *view.image.code_scale : 0;
    for (const double depth : view.image.depths) {
      if (!std::isfinite(depth)) continue;
      ++valid;
      if (depth > greatest) {
        greatest = depth;
        count = 0;
        is_code = depth == last;
      }
      if (depth == greatest) ++count;
    }
  }
  const bool is_frequent = count * 200 >= valid && count * 20 <= valid * 19;
  if (count == 0 || (!is_code && !is_frequent)) return std::nullopt;
  return Ceiling{greatest, count};
}

DataSet::DataSet(const Scene& scene, std::vector<View> views, int threads)
    : scene_(&scene), views_(std::move(views)), ceiling_(ceiling_of(views_)), threads_(threads) {}

bool DataSet::has_other_sizes() const {
  return std::ranges::any_of(views_, [](const View& v) {
    return v.image.size.width != v.camera.width || v.image.size.height != v.camera.height;
  });
}

bool DataSet::has_turned_sizes() const {
  return has_other_sizes() && std::ranges::all_of(views_, [](const View& v) {
           return v.image.size.width == v.camera.height && v.image.size.height == v.camera.width;
         });
}

const std::vector<Grid>& DataSet::grids(const Hypothesis& hypothesis, std::size_t images,
                                        std::size_t pixels) {
  const Hypothesis wanted = rendering_of(hypothesis);
  const auto known = std::ranges::find_if(renderings_, [&](const Rendering& r) {
    return r.hypothesis == wanted && r.images == images && r.pixels == pixels;
  });
  if (known != renderings_.end()) {
    renderings_.splice(renderings_.begin(), renderings_, known);
  } else {
    renderings_.push_front({wanted, images, pixels, rendered(wanted, images, pixels)});
    while (renderings_.size() > 1 && renderings_.size() * views_.size() > kept_grids)
      renderings_.pop_back();
  }
  return renderings_.front().grids;
}

std::vector<Grid> DataSet::rendered(const Hypothesis& hypothesis, std::size_t images,
                                    std::size_t pixels) const {
  std::vector<Grid> grids;
  RenderOptions options;
  options.channels = {Channel::Z, Channel::distance};
  options.threads = threads_;
  for (std::size_t i = 0; i < std::min(images, views_.size()); ++i) {
    const View& view = views_[i];
    Grid grid = grid_of(corrected(view.camera, hypothesis, view.image.size), pixels);
    const Camera camera = camera_of_grid(grid.camera, grid);
    const Rendered rendered = render(*scene_, camera, options);
    grid.depths = values_of(rendered.map, "Z");
    grid.distances = values_of(rendered.map, "distance");
    grids.push_back(std::move(grid));
  }
  return grids;
}

std::vector<Pair> DataSet::pairs(const std::vector<Grid>& grids, const Hypothesis& hypothesis,
                                 CeilingPixels of_ceiling) const {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const Grid& grid = grids[i];
    const DepthImage& image = views_[i].image;
    const std::vector<float>& exact = hypothesis.is_distance ? grid.distances : grid.depths;
    const double added = hypothesis.is_truncated ? image.step() / 2 : 0;
    for (std::uint32_t y = 0; y < grid.height; ++y) {
      for (std::uint32_t x = 0; x < grid.width; ++x) {
        const auto place = stored_place(hypothesis, grid.camera, grid.first + x * grid.stride,
                                        grid.first + y * grid.stride);
        const std::optional<double> stored = image.at(place);
        if (!stored) continue;
        const bool is_ceiling = ceiling_ && *stored == ceiling_->depth;
        if (of_ceiling == (is_ceiling ? CeilingPixels::left_out : CeilingPixels::alone)) continue;
        const bool is_none = is_ceiling && of_ceiling == CeilingPixels::as_none;
        const std::uint32_t block =
            std::uint32_t((i * blocks_across + y * blocks_across / grid.height) * blocks_across +
                          x * blocks_across / grid.width);
        const float depth = exact[std::size_t(y) * grid.width + x];
        pairs.push_back({.stored = is_none ? no_value : float(*stored + added),
                         .exact = depth > 0 ? depth : no_value,
                         .step = float(image.step()),
                         .block = block});
      }
    }
  }
  return pairs;
}

Agreement agreement(const std::vector<Pair>& pairs, double depth_scale,
                    const Tolerance& tolerance) {
  Agreement found;
  std::vector<double> depths, residuals;
  for (const Pair& pair : pairs)
    if (std::isfinite(pair.stored)) depths.push_back(pair.stored / depth_scale);
  found.pixels = depths.size();
  double range = 0;
  if (!depths.empty()) {
    std::ranges::sort(depths);
    range = depths[depths.size() * 95 / 100] - depths[depths.size() * 5 / 100];
  }
  std::uint64_t near = 0, same = 0;
  for (const Pair& pair : pairs) {
    const bool is_stored = std::isfinite(pair.stored), is_exact = std::isfinite(pair.exact);
    if (is_stored == is_exact) ++same;
    if (!is_stored || !is_exact) continue;
    const double residual = std::abs(pair.stored / depth_scale - pair.exact);
    // binary32 rounds both depths; a code is half its step away, rounded likewise.
    const double least = 0.5 * pair.step / depth_scale + 4e-7 * double(pair.exact);
    const double limit =
        std::max(least, std::min(tolerance.of_depth * pair.exact, tolerance.of_range * range));
    if (residual <= limit) ++near;
    residuals.push_back(residual);
  }
  if (found.pixels > 0) found.share = double(near) / double(found.pixels);
  if (!pairs.empty()) found.silhouettes = double(same) / double(pairs.size());
  found.compared = residuals.size();
  if (!residuals.empty()) {
    found.largest = *std::ranges::max_element(residuals);
    found.median = median_of(residuals);
  }
  return found;
}

double median_ratio(const std::vector<Pair>& pairs) {
  std::vector<double> ratios;
  for (const Pair& pair : pairs)
    if (std::isfinite(pair.stored) && std::isfinite(pair.exact))
      ratios.push_back(double(pair.stored) / pair.exact);
  return ratios.empty() ? 1 : median_of(ratios);
}

double median_relative(const std::vector<Pair>& pairs, double depth_scale) {
  std::vector<double> residuals;
  for (const Pair& pair : pairs)
    if (std::isfinite(pair.stored) && std::isfinite(pair.exact))
      residuals.push_back(std::abs(pair.stored / depth_scale - pair.exact) / pair.exact);
  return residuals.empty() ? std::numeric_limits<double>::infinity() : median_of(residuals);
}

}  // namespace fathom::doctor
