#pragma once

#include <string>

#include "validation/report/validation_case.h"

namespace fathom::app {

/// Values of --model that name none: the one that fits best, and, of a renderer that draws here, the
/// one that is of its variant.
inline constexpr const char* any_model = "auto";
inline constexpr const char* matching = "matching";

/// The model that --model names.
/// Fails    UsageError where there is none, or where it needs near and far and the camera has not
///          both.
attribution::RendererModel model_for(const std::string& model, const Camera& camera);

/// Sets what is found in a map that someone brings: by the model that --model names, or by the one
/// that fits best. Of `made`, scene, map and truth are there.
/// Fails    as model_for().
void judge_brought(const std::string& model, validation::ValidationCase& made);

}  // namespace fathom::app
