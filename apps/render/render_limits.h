#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/render/render_plan.h"
#include "fathom/camera/camera.h"
#include "fathom/fast/stream.h"
#include "fathom/rendering/options.h"

namespace fathom::app {

/// Refuses cameras whose maps the file or the depth format cannot hold, or that take more memory
/// than there is or --max-memory allows, before any is tried: a map, and what is needed to write
/// it. `output` is their name for messages. Fails with OutputError, InputError and UsageError.
/// `in_bands`: a map is never whole in memory, but a few rows of it.
void check_cameras(const std::vector<Camera>& cameras, const MapPlan& plan,
                   const std::string& output, bool in_bands = false);
/// The same for deep maps, whose size is known when they are there.
void check_cameras(const std::vector<Camera>& cameras, const DeepMapPlan& plan,
                   const std::string& output);

/// Of the memory that the map leaves over of what is allowed, a quarter for tiles, an eighth for
/// the triangles that channel A needs, a sixteenth for those that are read at a time.
StreamLimits stream_limits(const Camera& camera, const RenderOptions& options);

/// Limits TBB's threads during its lifetime (0: no limit). Also lets TBB use more threads than
/// processors, which it would otherwise refuse with a warning on standard error.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;
  ~ThreadLimit();

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

}  // namespace fathom::app
