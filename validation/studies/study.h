#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

/// Studies of depth precision: each computes figures, draws them, and explains what is seen.
namespace fathom::studies {

/// A file that a study makes: CSV, JSON, HTML, PNG or SVG.
struct StudyFile {
  std::string name;
  std::string content;
};

/// A scene and how it is seen.
struct SceneView {
  std::string name;
  Scene scene;
  Camera camera;
};

/// What can be asked of a study; each has its own defaults, which show the effect.
struct StudyOptions {
  /// What to look at, for studies that take a scene; without one they have their own.
  std::optional<SceneView> scene;
  std::optional<double> near, far;
  /// Of two surfaces, along the view.
  std::optional<double> separation;
  std::optional<std::uint32_t> samples;
};

/// A study. `run` calls `tick` with the share of the work that is done, from 0 to 1.
/// Fails    UsageError for options that mean nothing; OutputError where plots cannot be drawn.
struct Study {
  const char* name;
  const char* description;
  bool takes_scene;
  std::vector<StudyFile> (*run)(const StudyOptions&, const std::function<void(double)>& tick);
};

const std::vector<Study>& all_studies();

/// Fails    UsageError, naming those that exist.
const Study& study_named(const std::string& name);

}  // namespace fathom::studies
