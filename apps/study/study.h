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

// The studies that study.cpp lists: the question of each, and its defaults.

/// Coverage by samples against the exact area `A`: the error of every pattern, and how many of the
/// pixels that an edge crosses 1, 2, 4 and 8 samples see as partly covered. Default: a wheel.
std::vector<StudyFile> study_antialiasing(const StudyOptions& options,
                                          const std::function<void(double)>& tick);

/// The study `blending`.
std::vector<StudyFile> study_blending(const StudyOptions& options,
                                      const std::function<void(double)>& tick);

/// Where Sutherland–Hodgman is wrong: the bridging edges that it leaves on concave polygons, beside
/// Weiler–Atherton's pieces and the convex decomposition, on named shapes and on random polygons of
/// more and more corners. Clipped exactly; lengths are computed in binary64. And Weiler–Atherton
/// beside CGAL's Boolean set operations: the same answers, and in what time.
/// Defaults: 100 random polygons for each number of corners. near and far mean nothing here.
std::vector<StudyFile> study_clipping(const StudyOptions& options,
                                      const std::function<void(double)>& tick);

/// The study `course`.
std::vector<StudyFile> study_course(const StudyOptions& options,
                                    const std::function<void(double)>& tick);

/// The step of every depth format (mapping by storage) in world units, against depth; where each is
/// best; how it moves with near and with far. All figures are exact, rounded once.
/// Defaults: near 0.1, far 1000, 121 depths evenly spaced in the logarithm.
std::vector<StudyFile> study_depth_resolution(const StudyOptions& options,
                                              const std::function<void(double)>& tick);

/// The study `hidden-surface`.
std::vector<StudyFile> study_hidden_surface(const StudyOptions& options,
                                            const std::function<void(double)>& tick);

/// Of many depths between near and far, how many neighbours are stored as equal, and how many
/// swapped, for every projection, storage and way to apply the matrices, in exact arithmetic, with
/// each source of rounding alone and with all of them.
/// Defaults: near 0.1, far 10000, 10001 depths.
/// Source   N. Reed, Depth Precision Visualized (2015); P. Upchurch, M. Desbrun, Tightening the
///          Precision of Perspective Rendering, JGT 16 (2012).
std::vector<StudyFile> study_indistinguishable(const StudyOptions& options,
                                               const std::function<void(double)>& tick);

/// The study `lines`.
std::vector<StudyFile> study_lines(const StudyOptions& options,
                                   const std::function<void(double)>& tick);

/// What helps against z-fighting: a farther near plane, polygon offset, reversed z, a logarithmic
/// mapping; pixels that fight before and after, and hidden surfaces that an offset makes show.
/// Defaults: panels with decals at twelve distances, near 0.01, far 1000, standard unorm24.
std::vector<StudyFile> study_mitigation(const StudyOptions& options,
                                        const std::function<void(double)>& tick);

/// What moving corners to a subpixel grid does to coverage and depth: 0 to 16 bits against the
/// exact map. Default: a wheel.
std::vector<StudyFile> study_subpixel(const StudyOptions& options,
                                      const std::function<void(double)>& tick);

/// Two nearly coplanar surfaces: the share of samples at which a format lets the wrong one win, by
/// distance and separation, in the ideal and in the pipeline model; the least safe separation,
/// measured and predicted.
/// Defaults: near 0.1, far 100, separation 0.0001, tilt 30°, 64 samples of the patch.
std::vector<StudyFile> study_z_fighting(const StudyOptions& options,
                                        const std::function<void(double)>& tick);

/// z-fighting on options.scene: which pixels fight in every format, with pictures; the greatest
/// separations that are lost, by distance.
std::vector<StudyFile> study_scene_fights(const StudyOptions& options,
                                          const std::function<void(double)>& tick);

}  // namespace fathom::studies
