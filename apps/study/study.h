#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

/// Studies of depth precision. Each computes figures, draws them, and explains the results.
namespace fathom::studies {

class Table;

/// A file that a study makes: CSV, JSON, HTML, PNG or SVG. A CSV file also has its table, whose
/// numbers are not rounded.
struct StudyFile {
  std::string name;
  std::string content;
  std::shared_ptr<const Table> table;
};

/// A scene and its camera.
struct SceneView {
  std::string name;
  Scene scene;
  Camera camera;
};

/// The options of a study. Each study has its own defaults, which show the effect.
struct StudyOptions {
  /// The scene, for studies that take one. Without it they use their own scene.
  std::optional<SceneView> scene;
  std::optional<double> near, far;
  /// Of two surfaces, along the view.
  std::optional<double> separation;
  std::optional<std::uint32_t> samples;
  /// Whether plots are drawn: gnuplot takes most of the time of the quicker studies.
  bool plots = true;
};

/// A study. `run` calls `tick` with the share of the work that is done, from 0 to 1.
/// Fails    UsageError for meaningless options; OutputError if plots are requested and cannot be
///          drawn.
struct Study {
  const char* name;
  const char* description;
  bool takes_scene;
  std::vector<StudyFile> (*run)(const StudyOptions&, const std::function<void(double)>& tick);
};

const std::vector<Study>& all_studies();

/// Fails    UsageError, naming the existing studies.
const Study& study_named(const std::string& name);

// The studies in the list of study.cpp, each with its question and its defaults.

/// Coverage by samples against the exact area `A`: the error of every pattern, and how many of the
/// pixels that an edge crosses 1, 2, 4 and 8 samples see as partly covered. Default: a wheel.
std::vector<StudyFile> study_antialiasing(const StudyOptions& options,
                                          const std::function<void(double)>& tick);

/// The study `blending`.
std::vector<StudyFile> study_blending(const StudyOptions& options,
                                      const std::function<void(double)>& tick);

/// The bridging edges that Sutherland–Hodgman wrongly leaves on concave polygons, compared with the
/// pieces of Weiler–Atherton and of the convex decomposition, on named shapes and on random
/// polygons with more and more corners. Clipping is exact; lengths are computed in binary64. Also
/// compares Weiler–Atherton with CGAL's Boolean set operations: equal answers, and the times.
/// Defaults: 100 random polygons for each number of corners. near and far are not used.
std::vector<StudyFile> study_clipping(const StudyOptions& options,
                                      const std::function<void(double)>& tick);

/// The study `course`.
std::vector<StudyFile> study_course(const StudyOptions& options,
                                    const std::function<void(double)>& tick);

/// The step of every depth format (mapping by storage) in world units, by depth; where each format
/// is best; how the step changes with near and with far. All figures are exact, rounded once.
/// Defaults: near 0.1, far 1000, 121 depths evenly spaced in the logarithm.
std::vector<StudyFile> study_depth_resolution(const StudyOptions& options,
                                              const std::function<void(double)>& tick);

/// The study `hidden-surface`.
std::vector<StudyFile> study_hidden_surface(const StudyOptions& options,
                                            const std::function<void(double)>& tick);

/// The number of neighbours among many depths between near and far that are stored as equal depths,
/// and the number that are swapped, for every projection, storage and way to apply the matrices: in
/// exact arithmetic, with each source of rounding alone, and with all of them. Defaults: near 0.1,
/// far 10000, 10001 depths.
/// Source   N. Reed, Depth Precision Visualized (2015); P. Upchurch, M. Desbrun, Tightening the
///          Precision of Perspective Rendering, JGT 16 (2012).
std::vector<StudyFile> study_indistinguishable(const StudyOptions& options,
                                               const std::function<void(double)>& tick);

/// Lenses as other programs compute them, against the exact map: OpenCV's and COLMAP's inverses,
/// bent vertices, looked-up maps of a pinhole; errors in pixels, of depth and of surfaces, by model
/// and strength, and the mesh that bent vertices need. Default: a corridor, and four lenses.
std::vector<StudyFile> study_lens(const StudyOptions& options,
                                  const std::function<void(double)>& tick);

/// The study `lines`.
std::vector<StudyFile> study_lines(const StudyOptions& options,
                                   const std::function<void(double)>& tick);

/// Remedies against z-fighting: a farther near plane, polygon offset, reversed z, a logarithmic
/// mapping. Counts fighting pixels before and after, and pixels at which an offset makes hidden
/// surfaces visible. Defaults: panels with decals at twelve distances, near 0.01, far 1000,
/// standard unorm24.
std::vector<StudyFile> study_mitigation(const StudyOptions& options,
                                        const std::function<void(double)>& tick);

/// The effect of a subpixel grid on coverage and depth: corners are moved to grids of 0 to 16 bits,
/// and the maps compared with the exact map. Default: a wheel.
std::vector<StudyFile> study_subpixel(const StudyOptions& options,
                                      const std::function<void(double)>& tick);

/// Two nearly coplanar surfaces: the share of samples at which the wrong surface wins in a format,
/// by distance and separation, in the ideal and in the pipeline model; the least safe separation,
/// measured and predicted. Defaults: near 0.1, far 100, separation 0.0001, tilt 30°, 64 samples of
/// the patch.
std::vector<StudyFile> study_z_fighting(const StudyOptions& options,
                                        const std::function<void(double)>& tick);

/// z-fighting in options.scene: the fighting pixels in every format, with pictures; the greatest
/// separations that are lost, by distance.
std::vector<StudyFile> study_scene_fights(const StudyOptions& options,
                                          const std::function<void(double)>& tick);

}  // namespace fathom::studies
