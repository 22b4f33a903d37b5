#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/shell/console.h"
#include "apps/shell/output_file.h"
#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"

namespace fathom::app {

/// The outputs of a data set without faults: cameras.json, depth/*.exr and a manifest, which marks
/// the files as made by this program, so that a later run may replace them. They are opened before
/// the work and appear together.
class CorrectedFolder {
 public:
  /// `cameras`: the cameras as given, of which the names of the depth images are made.
  /// Fails    UsageError if a file is there that this program has not made, unless it overwrites,
  ///          or an output is an input; OutputError as OutputFile.
  CorrectedFolder(std::filesystem::path folder, const std::vector<Camera>& cameras, bool overwrites,
                  const Console& console);

  /// Writes the depth image of one camera.
  void write_depth(std::size_t camera, const DepthMap& map) const;
  /// Writes the cameras and puts all files in their places. Called after all depth images.
  void finish(const std::vector<Camera>& cameras);

 private:
  std::filesystem::path folder_;
  /// Below the folder; the cameras are the last.
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<OutputFile>> files_;
};

}  // namespace fathom::app
