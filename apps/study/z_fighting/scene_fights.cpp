#include "apps/study/z_fighting/scene_fights.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/study/sweeps.h"
#include "fathom/area/coverage_image.h"
#include "fathom/camera/camera_files.h"
#include "fathom/depth_format/encode.h"
#include "fathom/depth_format/resolution.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/referee.h"

namespace fathom::studies {

using area::BoxedTriangle;
using area::TriangleBands;
using triangle::centre_of_pixel;
using triangle::ProjectedTriangle;
using triangle::Referee;
using triangle::SceneRays;

namespace {

std::vector<LayeredSample> samples_of(const TriangleBands::Band& band, const Camera& camera,
                                      Referee& referee) {
  std::vector<LayeredSample> all(static_cast<std::size_t>(band.end_row - band.first_row) *
                                 camera.width);
  RenderStatistics uncounted;
  for (const BoxedTriangle& boxed : band.triangles) {
    const PixelBox& box = boxed.box;
    const std::uint32_t end_row = std::min(box.last_row + 1, band.end_row);
    for (std::uint32_t row = std::max(box.first_row, band.first_row); row < end_row; ++row) {
      for (std::uint32_t column = box.first_column; column <= box.last_column; ++column) {
        const ImagePoint s = centre_of_pixel(column, row);
        if (!referee.covers(boxed.number, s, uncounted)) continue;
        if (!referee.is_in_range(boxed.number, s, uncounted)) continue;
        const Ratio depth = depth_at(referee.projected(boxed.number), s);
        LayeredSample& sample =
            all[static_cast<std::size_t>(row - band.first_row) * camera.width + column];
        sample.column = column;
        sample.row = row;
        sample.layers.push_back({boxed.number, depth, round_to_binary64(depth)});
      }
    }
  }
  std::erase_if(all, [](const LayeredSample& s) { return s.layers.size() < 2; });
  for (LayeredSample& s : all) {
    const auto nearest =
        std::min_element(s.layers.begin(), s.layers.end(),
                         [](const Layer& a, const Layer& b) { return a.depth < b.depth; });
    s.visible = static_cast<std::size_t>(nearest - s.layers.begin());
  }
  return all;
}

/// Half a unit in the last place of a rounded depth.
Certified<double> certified_depth(const Layer& layer) {
  return {layer.rounded, layer.rounded * 0x1p-53};
}

}  // namespace

std::vector<LayeredSample> layered_samples(const SceneView& view) {
  const TriangleSource triangles(view.scene);
  const SceneRays rays(triangles, view.camera);
  tbb::enumerable_thread_specific<Referee> referees(
      [&] { return Referee(triangles, view.camera, &rays); });
  const TriangleBands bands({triangles, view.camera, Cull::none});
  std::vector<std::vector<LayeredSample>> parts(bands.count());
  tbb::parallel_for(std::uint32_t{0}, bands.count(), [&](std::uint32_t i) {
    parts[i] = samples_of(bands[i], view.camera, referees.local());
  });
  std::vector<LayeredSample> all;
  for (auto& part : parts) std::move(part.begin(), part.end(), std::back_inserter(all));
  return all;
}

StoredDepth encode_layer(const CertifiedFormat& format, const Layer& layer) {
  if (const auto stored = format.encode(certified_depth(layer))) return *stored;
  const Certified<double> D = certified_depth(layer);
  if (const auto stored = format.encode(Certified<WordPair>{{D.value}, D.error})) return *stored;
  return encode(format.format(), layer.depth);
}

std::vector<LostSeparation> lost_separations(const std::vector<LayeredSample>& samples,
                                             const DepthFormat& format) {
  const CertifiedFormat certified(format);
  std::map<int, double> lost;  // class: depths from 2^((k−1)/2) to 2^(k/2)
  for (const LayeredSample& sample : samples) {
    const Layer& visible = sample.layers[sample.visible];
    const int k = static_cast<int>(std::ceil(2 * std::log2(visible.rounded)));
    double& greatest = lost[k];
    const StoredDepth stored = encode_layer(certified, visible);
    for (const Layer& other : sample.layers) {
      if (other.rounded - visible.rounded <= greatest) continue;
      if (encode_layer(certified, other) == stored) {
        greatest = round_to_binary64(other.depth - visible.depth);
      }
    }
  }
  std::vector<LostSeparation> result;
  for (const auto& [k, greatest] : lost) {
    const double end = std::clamp(std::exp2(k / 2.0), format.near, format.far);
    result.push_back({end, greatest, bin_width(format, Dyadic(end))});
  }
  return result;
}

namespace {

/// The window depth of a triangle: z = far/(far − near) − k/D with k = near·far/(far − near), and
/// 1/D = w/n, w affine on the image and n constant under a perspective camera.
WindowSlopes slopes_of(const ProjectedTriangle& t, const DepthFormat& format) {
  const Ratio near = Dyadic(format.near), far = Dyadic(format.far);
  const Ratio k = quotient(near * far, far - near);
  const Ratio n = t.depth_numerator.coefficients()[2];
  const auto slope = [&](std::size_t i) {
    return Ratio() - quotient(k * Ratio(t.weight.coefficients()[i]), n);
  };
  Ratio greatest;
  for (const CameraPoint& corner : t.camera) {
    if (corner.z.sign() != Sign::positive) continue;
    const Ratio z = *stored_value(format, corner.z).rational();
    if (greatest < z) greatest = z;
  }
  return {slope(0), slope(1), greatest};
}

Ratio window_depth_of(const DepthFormat& format, const Layer& layer) {
  return *stored_value(format, layer.depth).rational();
}

StoredDepth store(const DepthFormat& format, const Layer& layer, double z, const Ratio& offset,
                  double offset_rounded) {
  // Two roundings of the terms and one of the sum, of numbers not above 2.
  const double sum = z + offset_rounded;
  if (sum > 0x1p-30 && sum < 1 - 0x1p-30) {
    if (const auto stored = certified_rounding(format.storage, {sum, 0x1p-51})) return *stored;
  }
  return round_to_storage(format.storage, biased_depth(window_depth_of(format, layer), offset));
}

}  // namespace

OffsetLayers::OffsetLayers(const SceneView& of, const std::vector<LayeredSample>& seen,
                           const DepthFormat& stored, std::uint32_t first_number)
    : view(of), samples(seen), format(stored), first(first_number) {
  window_depths.reserve(samples.size());
  for (const LayeredSample& sample : samples) {
    auto& depths = window_depths.emplace_back();
    for (const Layer& layer : sample.layers) {
      depths.push_back(round_to_binary64(window_depth_of(format, layer)));
    }
  }
}

OffsetCount count_with_offset(const OffsetLayers& layers, const DepthBias& bias) {
  OffsetCount count{bias};
  const TriangleSource triangles(layers.view.scene);
  Referee referee(triangles, layers.view.camera);
  std::map<std::uint32_t, std::pair<Ratio, double>> offsets;
  const auto offset_of = [&](std::uint32_t number) -> const std::pair<Ratio, double>& {
    const auto found = offsets.find(number);
    if (found != offsets.end()) return found->second;
    const Ratio o = number < layers.first
                        ? Ratio()
                        : depth_offset(layers.format.storage, bias,
                                       slopes_of(referee.projected(number), layers.format));
    return offsets[number] = {o, round_to_binary64(o)};
  };
  for (std::size_t i = 0; i < layers.samples.size(); ++i) {
    const LayeredSample& sample = layers.samples[i];
    const Layer* winner = nullptr;
    StoredDepth least;
    for (std::size_t k = 0; k < sample.layers.size(); ++k) {
      const Layer& layer = sample.layers[k];
      const auto& [offset, rounded] = offset_of(layer.number);
      const StoredDepth stored =
          store(layers.format, layer, layers.window_depths[i][k], offset, rounded);
      if (!winner || stored < least) {
        winner = &layer;
        least = stored;
      }
    }
    const Layer& visible = sample.layers[sample.visible];
    if (winner->number == visible.number) continue;
    const bool false_positive = winner->number >= layers.first && visible.number < layers.first;
    ++(false_positive ? count.shows_through : count.fights);
  }
  return count;
}

BufferedScene buffer_scene(const SceneView& view, const DepthMap& visible,
                           const DepthFormat& format) {
  BufferedScene buffered{{.format = format}, visible};
  buffered.fights.fighting =
      add_depth_buffer(buffered.map, view.scene, view.camera, {format, true, {}}).fighting;
  const auto& id = *buffered.map.values<std::uint32_t>("id");
  const auto& error = *buffered.map.values<float>("Zerror");
  for (std::size_t i = 0; i < id.size(); ++i) {
    if (id[i] == no_surface) continue;
    ++buffered.fights.surface_pixels;
    buffered.fights.greatest_error =
        std::max(buffered.fights.greatest_error, static_cast<double>(std::abs(error[i])));
  }
  return buffered;
}

std::vector<FightPicture> pictures_of(const std::string& name, const BufferedScene& buffered,
                                      const std::string& scene, const std::string& camera) {
  const DepthFormat& format = buffered.fights.format;
  const std::string unit = fmt::format("{}, near {:.3g}", label_of(format), format.near);
  const double end = std::max(buffered.fights.greatest_error, 1e-30);
  const std::string map = fmt::format(
      "fathom render {} --camera {} --depth-format {} --mapping {} --against-exact -o map.exr",
      scene, camera, name_of(format.storage), name_of(format.mapping));
  return {{picture("fights-" + name, buffered.map, {.channel = "Zfight", .unit = unit}),
           fmt::format("{} && fathom preview map.exr --channel Zfight --unit '{}' -o fights-{}.png",
                       map, unit, name)},
          {picture("error-" + name, buffered.map,
                   {.channel = "Zerror", .low = -end, .high = end, .unit = unit}),
           fmt::format("{} && fathom preview map.exr --channel Zerror --range {},{} --unit '{}' "
                       "-o error-{}.png",
                       map, -end, end, unit, name)}};
}

StudyFile camera_file(const std::string& name, const Camera& camera) {
  return {name + ".json", to_json(camera) + "\n"};
}

}  // namespace fathom::studies
