#pragma once

#include <string>
#include <vector>

#include "apps/render/render_arguments.h"
#include "apps/shell/output_file.h"

namespace fathom::app {

/// The outputs of `render`: for each camera the file of each -o and, if requested, a picture and a
/// description of the codes of each PNG; the cameras; the statistics. All are opened before the
/// work and published together when every file is written.
class RenderOutputs {
 public:
  /// Fails    UsageError where the names do not fit the number of cameras; as OutputFile.
  RenderOutputs(const RenderArguments& arguments, const std::vector<Camera>& cameras);

  /// `number` counts the -o.
  [[nodiscard]] const std::string& map_name(std::size_t camera, std::size_t number = 0) const {
    return maps_[number].names[camera];
  }
  [[nodiscard]] const OutputFile& map(std::size_t camera, std::size_t number = 0) const {
    return maps_[number].files[camera];
  }
  [[nodiscard]] const OutputFile& sidecar(std::size_t camera, std::size_t number = 0) const {
    return maps_[number].sidecars[camera];
  }
  [[nodiscard]] const OutputFile& picture(std::size_t camera) const { return pictures_[camera]; }

  void write_cameras(const std::string& json) { cameras_.write(json); }
  void write_statistics(const std::string& json) { statistics_.write(json); }

  /// Puts all of them in their places, then prints what goes to standard output.
  void commit();

 private:
  /// The files of one -o, for each camera.
  struct Maps {
    std::vector<std::string> names;
    std::vector<OutputFile> files, sidecars;
  };

  std::vector<Maps> maps_;
  std::vector<OutputFile> pictures_;
  TextOutput cameras_, statistics_;
};

}  // namespace fathom::app
