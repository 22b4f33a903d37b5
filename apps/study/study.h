#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

/// Studies of depth precision: each computes figures, draws them, and explains what is seen.
namespace fathom::studies {

class Table;

/// A file that a study makes: CSV, JSON, HTML, PNG or SVG. CSV has the table that it was made of,
/// whose numbers are not rounded.
struct StudyFile {
  std::string name;
  std::string content;
  std::shared_ptr<const Table> table;
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
  /// Whether plots are drawn: gnuplot takes most of the time of the quicker studies.
  bool plots = true;
};

/// A study. `run` calls `tick` with the share of the work that is done, from 0 to 1.
/// Fails    UsageError for options that mean nothing; OutputError where plots are to be drawn and
///          cannot be.
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
