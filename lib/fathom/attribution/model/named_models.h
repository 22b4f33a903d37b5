#pragma once

#include <string>

#include "fathom/attribution/model/renderer_model.h"

/// Models of renderers of which no more is known than their kind (docs/validation.md, "Models").
namespace fathom::attribution {

/// "gl-unorm16, gl-unorm24, …".
std::string model_names();

/// Fails    UsageError where there is no such model, naming those that there are.
RendererModel model_named(const std::string& name);

}  // namespace fathom::attribution
