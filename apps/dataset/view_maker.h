#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/dataset/codes_beyond.h"
#include "apps/render/render_plan.h"
#include "apps/render/render_report.h"
#include "fathom/fast/render_memory.h"
#include "fathom/scene/scene.h"

namespace fathom::app {

/// Makes the map of each camera of a path, for the tasks of a job.
class ViewMaker {
 public:
  /// Fails    InputError where memory does not hold a map of one of the cameras.
  ViewMaker(Scene scene, std::vector<Camera> cameras, MapPlan plan);

  /// What the map of a camera depends on, for the key of its task.
  [[nodiscard]] std::string inputs_of(std::size_t camera) const;
  /// `name` is the map's for messages.
  [[nodiscard]] std::shared_ptr<const DepthMap> make(std::size_t camera, const std::string& name);
  /// About so many bytes does a map of this camera take.
  [[nodiscard]] std::size_t memory_of(std::size_t camera) const;

  [[nodiscard]] const MapPlan& plan() const { return plan_; }
  /// Warns of what is probably not meant by the cameras whose maps have been made, and of depths that
  /// lie beyond their codes.
  void warn(const Console& console) const;

 private:
  Scene scene_;
  std::vector<Camera> cameras_;
  MapPlan plan_;
  std::string inputs_;
  RenderMemory memory_;
  CameraWarnings warnings_;
  CodesBeyond codes_beyond_;
};

}  // namespace fathom::app
