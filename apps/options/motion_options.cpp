#include "apps/options/motion_options.h"

#include <fmt/core.h>

#include "apps/shell/known_files.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/files/sha256.h"

namespace fathom::app {

void MotionOptions::add_to(Command& command) {
  command.option("--motion", "FILE", file,
                 "Keyframes of moving objects (JSON; see pipeline.md in the documentation); the "
                 "default camera frames the scene without motion");
  command.option("--time", "T", into(time, parse_number),
                 "Time at which to place the objects of --motion (default 0)");
}

MovingScene MotionOptions::moving(Scene scene) const {
  const files::InputFile input{std::filesystem::path(file)};
  note_input(file);
  Motion motion = read_motion(input.text(), file);
  scene.sources.push_back({file, files::sha256(input.bytes()), ""});
  return {std::move(scene), std::move(motion)};
}

Scene MotionOptions::placed(Scene scene) const {
  if (is_given()) return moving(std::move(scene)).take(time_or_start());
  if (time) throw UsageError("--time needs --motion, a file that says how objects move");
  return scene;
}

void MotionOptions::describe(DepthMap& map, double at) const {
  if (is_given()) map.texts["fathom.time"] = fmt::format("{}", at);
}

}  // namespace fathom::app
