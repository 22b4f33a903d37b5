#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/study/study.h"
#include "fathom/image/rgb_image.h"
#include "fathom/pipeline/options.h"

/// What the pictures of the page are drawn from lies in files beside it, so that the commands of
/// its captions draw them again.
namespace fathom::studies {

/// A scene and its camera, and the files that hold them: NAME.obj and NAME.json. `view` is what has
/// been read back from these files.
struct SceneFiles {
  SceneView view;
  std::vector<StudyFile> files;
};
/// `scene` has one mesh, and attributes for each vertex if any.
SceneFiles scene_files(const std::string& name, const Scene& scene, const Camera& camera);

/// The OBJ file of a scene of one mesh; numbers come back as they were.
std::string obj_of(const Scene& scene);

/// What `fathom render FILE` reads.
Scene scene_in(const StudyFile& file);

/// What `fathom render --engine pipeline --image` draws.
RgbImage pipeline_picture(const SceneView& view, const pipeline::PipelineOptions& options);

}  // namespace fathom::studies
