#pragma once

#include <memory>
#include <optional>
#include <string>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

/// Judges a map of unknown origin: only the claimed scene and camera are known, and perhaps the
/// kind of renderer.
namespace fathom::attribution {

/// The verdict on such a map.
struct Judgement {
  /// The judging model: the named model, unless another model explains pixels that it leaves open
  /// (model_choice.h).
  RendererModel model;
  /// The truth for the map's camera: the given camera, unless the map has another size.
  std::shared_ptr<const Truth> truth;
  /// The map as it was compared: with its background separated from surfaces, in the camera's size.
  OtherMap other;
  Attribution attribution;
};

/// The model with this name, for maps of this camera.
/// Fails    UsageError (setting `model`) if the name is unknown, or if the model needs near and far
///          and the camera lacks one of them.
RendererModel model_for(const std::string& name, const Camera& camera);

/// Judges with the given model; without a model, with the model that fits best, which becomes a
/// note. If the given model leaves pixels open and another model does not, this becomes a finding
/// of kind `model`.
/// Needs    a map of the size of the truth's camera.
Judgement judge(std::shared_ptr<const Truth> truth, const OtherMap& other,
                const std::optional<RendererModel>& model);

/// Judges a map of a scene. A map of another size than the camera's is judged by the reading of it
/// that explains most (other_scene.h). A map that fits its scene nowhere is reported as a map of
/// another scene (other_scene.h).
/// Fails    InputError that begins with `name`, the name of the map: if it shows triangles that the
///          scene does not have, or if no reading of its size explains half of it.
Judgement judge_map(const std::string& name, const OtherMap& other, const Scene& scene,
                    const Camera& camera, const std::optional<RendererModel>& model);

}  // namespace fathom::attribution
