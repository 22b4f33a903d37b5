#pragma once

#include <vector>

#include "apps/mpi/ranks.h"
#include "apps/mpi/shared_scene.h"
#include "apps/render/render_arguments.h"
#include "apps/shell/console.h"
#include "fathom/camera/camera.h"
#include "fathom/triangle/channels.h"

namespace fathom::app {

/// Both are called by all ranks.

/// Fails    as SharedScene; InputError where the ranks read different files.
SharedScene open_scene(const Ranks& ranks, const RenderArguments& arguments,
                       const SharedScene::Kept& kept, const Console& console);
/// The cameras that are asked for; places what moves, and warns of segments that channels ask for and
/// the scene has not.
/// Fails    as CameraOptions::get(); InputError where the ranks have different cameras.
std::vector<Camera> cameras_of(const Ranks& ranks, const RenderArguments& arguments,
                               const std::vector<Channel>& channels, SharedScene& scene,
                               const Console& console);

}  // namespace fathom::app
