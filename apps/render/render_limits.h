#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/render/render_plan.h"
#include "fathom/camera/camera.h"
#include "fathom/fast/stream.h"
#include "fathom/rendering/options.h"

namespace fathom::app {

/// Refuses cameras, before the first is rendered, if the file or the depth format cannot hold their
/// maps, if they have a lens and the plan adds to or verifies the maps, or if a map and the memory
/// for writing it exceed available memory or --max-memory.
/// `output` is their name for messages. Fails with OutputError, InputError and UsageError.
/// `in_bands`: only a few rows of a map are in memory at a time.
void check_cameras(const std::vector<Camera>& cameras, const MapPlan& plan,
                   const std::string& output, bool in_bands = false);
/// The same for deep maps, whose size is known when they are there.
void check_cameras(const std::vector<Camera>& cameras, const DeepMapPlan& plan,
                   const std::string& output);

/// Divides the allowed memory that the map leaves free: a quarter for tiles, an eighth for the
/// triangles that channel A needs, a sixteenth for triangles that are read at a time.
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
