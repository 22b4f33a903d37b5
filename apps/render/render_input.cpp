#include "apps/render/render_input.h"

#include <algorithm>

#include "apps/render/render_memory.h"
#include "apps/shell/known_files.h"
#include "fathom/numeric/errors.h"
#include "fathom/render.h"

namespace fathom::app {
namespace {

StreamedScene stream(const SceneOptions& options, bool segments, const Console& console) {
  const std::vector<std::string>& files = options.files;
  if (std::count(files.begin(), files.end(), "-") > 0) {
    throw UsageError("--stream: '-', standard input, cannot be read in parts; expected files");
  }
  Warnings warnings;
  ReadOptions reading = options.read_options();
  reading.segments = segments;
  StreamedScene scene = stream_scene({files.begin(), files.end()}, reading, warnings);
  console.warn(warnings);
  for (const std::string& file : files) note_input(file);
  return scene;
}

}  // namespace

RenderInput::RenderInput(const SceneOptions& options, Place place, const Kept& kept,
                         const Console& console) {
  if (place == Place::files) {
    streamed_ = stream(options, kept.segments, console);
    scene_ = outline_of(*streamed_);
  } else {
    scene_ = options.read(console,
                          {.hash = true, .attributes = kept.normals, .segments = kept.segments});
  }
}

void RenderInput::place(const MotionOptions& motion) {
  if (streamed_ && motion.is_given()) {
    throw UsageError("--motion needs the scene in memory, without --stream");
  }
  scene_ = motion.placed(std::move(scene_));
}

TriangleSource RenderInput::triangles() const {
  return streamed_ ? TriangleSource(*streamed_) : TriangleSource(scene_);
}

DepthMap RenderInput::render(const Camera& camera, const RenderOptions& options) const {
  return streamed_ ? fathom::render(*streamed_, camera, options, stream_limits(camera, options))
                   : fathom::render(scene_, camera, options);
}

}  // namespace fathom::app
