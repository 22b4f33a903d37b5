#include "apps/mpi/scene_together.h"

#include <optional>
#include <utility>

#include "apps/mpi/together.h"
#include "apps/render/render_report.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"

namespace fathom::app {

SharedScene open_scene(const Ranks& ranks, const RenderArguments& arguments,
                       const SharedScene::Kept& kept, const Console& console) {
  std::optional<SharedScene> opened;
  together(ranks, [&] { opened.emplace(arguments.scene, kept, console); });
  opened->check_files(ranks, console);
  require_same<InputError>(ranks, opened->description(), "the ranks read different files");
  return std::move(*opened);
}

std::vector<Camera> cameras_of(const Ranks& ranks, const RenderArguments& arguments,
                               const std::vector<Channel>& channels, SharedScene& scene,
                               const Console& console) {
  std::vector<Camera> cameras;
  together(ranks, [&] {
    cameras = arguments.camera.get(scene.outline(), console);
    scene.place(arguments.motion);
    warn_of_missing_segments(scene.triangles(), channels, console);
  });
  require_same<InputError>(ranks, to_json(cameras), "the ranks have different cameras");
  return cameras;
}

}  // namespace fathom::app
