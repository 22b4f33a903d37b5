#pragma once

#include <memory>
#include <optional>
#include <string>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

/// A map from outside. Only the claimed scene and camera are known, and perhaps the kind of
/// renderer.
namespace fathom::attribution {

/// Verdict on such a map.
struct Judgement {
  /// The judging model: the named model, unless another model explains pixels that it leaves open
  /// (model_choice.h).
  RendererModel model;
  /// Of the map's camera: the given camera, unless the map has another size.
  std::shared_ptr<const Truth> truth;
  /// As it was compared: its background told from surfaces, of the size that the camera has.
  OtherMap other;
  Attribution attribution;
};

/// The model of a name, for maps of this camera.
/// Fails    UsageError (setting `model`) if the name is unknown, or if the model needs near and far
///          and the camera lacks one of them.
RendererModel model_for(const std::string& name, const Camera& camera);

/// Judges by a model, or, without one, by the model that fits best, which is noted. Where the named
/// model leaves pixels open and another does not, that is a finding of kind `model`.
/// Needs    a map of the size of the truth's camera.
Judgement judge(std::shared_ptr<const Truth> truth, const OtherMap& other,
                const std::optional<RendererModel>& model);

/// Judges a map of a scene. One of another size than the camera's is judged as the reading of it
/// that explains most (other_scene.h), and a map that fits its scene nowhere is said to be of
/// another one (other_scene.h).
/// Fails    InputError that begins with `name`, the map's: it shows triangles that the scene has
///          not, or no reading of its size explains half of it.
Judgement judge_map(const std::string& name, const OtherMap& other, const Scene& scene,
                    const Camera& camera, const std::optional<RendererModel>& model);

}  // namespace fathom::attribution
