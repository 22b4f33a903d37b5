#include "validation/studies/antialiasing/antialiasing.h"

#include <nlohmann/json.hpp>

#include "fathom/numeric/errors.h"
#include "validation/studies/antialiasing/antialiasing_methods.h"
#include "validation/studies/antialiasing/coverage_by_samples.h"
#include "validation/studies/page.h"
#include "validation/studies/plot.h"
#include "validation/studies/study_scene.h"

namespace fathom::studies {
namespace {

SceneView view_of(const StudyOptions& options) {
  if (options.separation || options.samples) {
    throw UsageError("the study antialiasing has no --separation and no --samples");
  }
  SceneView view = options.scene ? *options.scene : wheel();
  if (options.near) view.camera.near = *options.near;
  if (options.far) view.camera.far = *options.far;
  if (const auto fault = find_fault(view.camera)) throw UsageError(*fault);
  return view;
}

}  // namespace

std::vector<StudyFile> study_antialiasing(const StudyOptions& options,
                                          const std::function<void(double)>& tick) {
  const SceneView view = view_of(options);
  require_gnuplot();
  const DepthMap exact = exact_coverage(view);
  const CoverageBySamples measured =
      measure_coverage_by_samples(view, exact, [&](double share) { tick(share / 2); });
  const AntialiasingMethods methods =
      measure_antialiasing([&](double share) { tick(0.5 + share / 2); });

  nlohmann::ordered_json summary{{"study", "antialiasing"}, {"scene", view.name}};
  add_to_summary(measured, summary);
  add_to_summary(methods, summary);
  Page page("Antialiasing");
  page.heading("Coverage by samples: " + view.name);
  add_to_page(measured, page);
  page.picture("coverage", "Exact coverage of the scene");
  add_to_page(methods, page);

  std::vector<StudyFile> files = files_of(measured);
  for (StudyFile& file : files_of(methods)) files.push_back(std::move(file));
  files.push_back({"summary.json", summary.dump(2) + "\n"});
  files.push_back(page.file());
  files.push_back(picture("coverage", exact, {.channel = "A", .colours = ColourMap::grey}));
  return files;
}

}  // namespace fathom::studies
