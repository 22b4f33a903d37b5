#include "apps/validate/validate_input.h"

#include "apps/options/camera_options.h"
#include "apps/shell/known_files.h"
#include "fathom/failures/errors.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {

Camera read_camera(const std::string& file, const Console& console) {
  if (file.empty()) throw UsageError("--camera FILE is missing");
  const std::vector<Camera> cameras = read_camera_file(file, console);
  if (cameras.size() != 1) {
    throw UsageError(file + ": is a camera path; expected a single camera");
  }
  return cameras.front();
}

Scene read_files(const std::vector<std::string>& files, const ReadLimits& limits,
                 const Console& console) {
  if (files.empty()) throw UsageError("SCENE is missing: what the map shows");
  for (const std::string& file : files) note_input(file);
  Warnings warnings;
  ReadOptions options = limits.read_options();
  options.hash = false;
  Scene scene = read_scene({files.begin(), files.end()}, options, warnings);
  console.warn(warnings);
  return scene;
}

}  // namespace fathom::app
