#pragma once

#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"

/// Models of renderers of which no more is known than their kind (docs/validation.md, "Models").
namespace fathom::attribution {

/// "gl-unorm16, gl-unorm24, …".
std::string model_names();

/// All of them, in that order.
std::vector<RendererModel> named_models();

/// Whether the camera has the near and far between which a model's depths are stored.
bool has_clip_planes_for(const RendererModel& model, const Camera& camera);

/// Whether it is a model of OpenGL as VTK uses it.
bool is_of_vtk(const RendererModel& model);

/// Fails    UnknownName where there is no such model, naming those that there are.
RendererModel model_named(const std::string& name);

}  // namespace fathom::attribution
