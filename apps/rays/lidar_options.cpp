#include "apps/rays/lidar_options.h"

#include <algorithm>
#include <type_traits>

#include "apps/rays/ray_file.h"
#include "apps/shell/values.h"
#include "fathom/camera/trajectory.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/rays/lidar_rays.h"

namespace fathom::app {
namespace {

ScanFrame parse_frame(const std::string& text) {
  return parse_word<ScanFrame>(text, {{"world", ScanFrame::world}, {"sensor", ScanFrame::sensor}});
}

template <class Real>
Real rounded(const Dyadic& x) {
  if constexpr (std::is_same_v<Real, float>) return round_to_binary32(Ratio(x));
  return round_to_binary64(Ratio(x));
}

}  // namespace

Option LidarOptions::add_to(Command& command) {
  const Option lidar = command.option("--lidar", "FILE", sensor,
                                      "Metadata of an Ouster sensor (JSON): cast the rays of one "
                                      "turn, in metres; ray row·columns + "
                                      "column is of beam `row`. Also writes .bin (KITTI), .ply, "
                                      ".pcd, .npy and .exr (range images)");
  command.option("--poses", "FILE", poses,
                 "Path of the lidar, lines `time tx ty tz qx qy qz qw` (sensor to world, metres, "
                 "seconds); a single line is a lidar at rest (default: at the world's zero)");
  command.option("--start", "SECONDS", into(start, parse_number),
                 "Time of column 0 (default: the first of --poses)");
  command.option("--frame", "NAME", into(frame, parse_frame),
                 "Frame of the points in .bin, .ply and .pcd: world or sensor (default: sensor for "
                 ".bin, else world)");
  command.flag("--destagger", destagger,
               "Shift the rows of range images by the sensor's pixel_shift_by_row");
  command.option("--write-rays", "FILE", rays_output,
                 "Also write the rays to this NPY file, as --rays reads it");
  return lidar;
}

void LidarOptions::check(const std::optional<ScanFile>& file) const {
  if (!sensor.empty()) {
    if (start && poses.empty()) throw UsageError("--start needs --poses");
    if (frame && (!file || !is_cloud(*file)))
      throw UsageError("--frame is for points, .bin, .ply and .pcd");
    if (destagger && (!file || is_cloud(*file)))
      throw UsageError("--destagger is for range images, .npy and .exr");
    return;
  }
  if (!poses.empty() || start || frame || destagger || !rays_output.empty())
    throw UsageError("--poses, --start, --frame, --destagger and --write-rays need --lidar");
}

LidarScan::LidarScan(const LidarOptions& options, int threads)
    : sensor_(read_ouster_sensor(options.sensor)),
      has_poses_(!options.poses.empty()),
      frame_(options.frame),
      destagger_(options.destagger),
      rays_output_(options.rays_output) {
  if (destagger_ && sensor_.shifts.empty())
    throw InputError(sensor_.name + ": 'pixel_shift_by_row' is missing, which --destagger needs");
  if (has_poses_) {
    const Trajectory path = Trajectory::read(options.poses);
    rays_ = lidar_rays(sensor_, &path, options.start.value_or(path.first_time()), threads);
  } else {
    rays_ = lidar_rays(sensor_, nullptr, 0, threads);
  }
}

void LidarScan::write_rays() const {
  if (rays_output_.empty()) return;
  OutputFile output(rays_output_);
  output.write(npy_of_rays(rays_));
  output.commit();
}

template <class Real>
Scan<Real> LidarScan::scan(const RayScene& scene, const CastOptions& options,
                           ScanFrame frame) const {
  const std::vector<RayHit> hits = cast(scene, rays_, options);
  Scan<Real> scan{sensor_.rows, sensor_.columns, {}, {}};
  scan.ids.resize(hits.size());
  std::ranges::transform(hits, scan.ids.begin(), &RayHit::triangle);
  scan.values = hit_values<Real>(scene.triangles(), rays_, scan.ids, options.threads);
  if (frame == ScanFrame::world || !has_poses_) return scan;
  const std::vector<Ray> rays_of_sensor = lidar_rays(sensor_, nullptr, 0, options.threads);
  for (std::size_t k = 0; k < hits.size(); ++k) {
    if (hits[k].triangle == no_triangle) continue;
    const Ray& ray = rays_of_sensor[k];
    for (int i = 0; i < 3; ++i)
      scan.values[k].position[i] =
          rounded<Real>(Dyadic(ray.origin[i]) + Dyadic(hits[k].t) * Dyadic(ray.direction[i]));
  }
  return scan;
}

bool LidarScan::write(const RayScene& scene, const CastOptions& options, ScanFile file,
                      const OutputFile& output) const {
  const ScanFrame usual = file == ScanFile::kitti ? ScanFrame::sensor : ScanFrame::world;
  bool has_hits = false;
  const auto write_as = [&](const auto& of_rays) {
    has_hits = std::ranges::any_of(of_rays.ids, [](auto id) { return id != no_triangle; });
    if (is_cloud(file)) {
      output.write(cloud_of(of_rays, file));
    } else {
      write_range_image(of_rays, file,
                        destagger_ ? std::span<const std::int32_t>(sensor_.shifts)
                                   : std::span<const std::int32_t>(),
                        output);
    }
  };
  const ScanFrame frame = frame_.value_or(usual);
  if (is_binary64(file)) {
    write_as(scan<double>(scene, options, frame));
  } else {
    write_as(scan<float>(scene, options, frame));
  }
  return has_hits;
}

}  // namespace fathom::app
