#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/rays/scan_files.h"
#include "apps/shell/command.h"
#include "fathom/rays/cast.h"
#include "fathom/rays/lidar_sensor.h"

namespace fathom::app {

/// Where the points of a scan are.
enum class ScanFrame { world, sensor };

/// `--lidar --poses --start --frame --destagger --write-rays` of `fathom cast`.
struct LidarOptions {
  std::string sensor;

  /// Returns --lidar.
  Option add_to(Command& command);
  /// `file` is the kind of the output; nullopt for a table.
  /// Fails    UsageError for an option that has no effect.
  void check(const std::optional<ScanFile>& file) const;

  std::string poses;
  std::optional<double> start;
  std::optional<ScanFrame> frame;
  bool destagger = false;
  std::string rays_output;
};

/// The rays of a turn of a lidar, and the file of what they meet.
class LidarScan {
 public:
  /// Reads the sensor and the poses.
  LidarScan(const LidarOptions& options, int threads);

  /// In the world; ray row·columns + column.
  [[nodiscard]] const std::vector<Ray>& rays() const { return rays_; }
  /// Writes the rays if they were asked for.
  void write_rays() const;
  /// Casts the rays and writes points or an image. Returns whether a ray meets the scene.
  bool write(const RayScene& scene, const CastOptions& options, ScanFile file,
             const OutputFile& output) const;

 private:
  template <class Real>
  [[nodiscard]] Scan<Real> scan(const RayScene& scene, const CastOptions& options,
                                ScanFrame frame) const;

  LidarSensor sensor_;
  std::vector<Ray> rays_;
  /// Whether the sensor's frame is not the world's.
  bool has_poses_;
  std::optional<ScanFrame> frame_;
  bool destagger_;
  std::string rays_output_;
};

}  // namespace fathom::app
