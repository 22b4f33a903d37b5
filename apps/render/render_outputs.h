#pragma once

#include <string>
#include <vector>

#include "apps/render/render_arguments.h"
#include "apps/shell/output_file.h"

namespace fathom::app {

/// The outputs of `render`: for each camera a map and, if requested, a picture and a description of
/// the codes; the cameras; the statistics. All are opened before the work and published together
/// when every file is written.
class RenderOutputs {
 public:
  /// Fails    UsageError where the names do not fit the number of cameras; as OutputFile.
  RenderOutputs(const RenderArguments& arguments, const std::vector<Camera>& cameras);

  [[nodiscard]] const std::string& map_name(std::size_t camera) const { return names_[camera]; }
  [[nodiscard]] const OutputFile& map(std::size_t camera) const { return maps_[camera]; }
  [[nodiscard]] const OutputFile& picture(std::size_t camera) const { return pictures_[camera]; }
  [[nodiscard]] const OutputFile& sidecar(std::size_t camera) const { return sidecars_[camera]; }

  void write_cameras(const std::string& json) { cameras_.write(json); }
  void write_statistics(const std::string& json) { statistics_.write(json); }

  /// Puts all of them in their places, then prints what goes to standard output.
  void commit();

 private:
  std::vector<std::string> names_;
  std::vector<OutputFile> maps_, pictures_, sidecars_;
  TextOutput cameras_, statistics_;
};

}  // namespace fathom::app
