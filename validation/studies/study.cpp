#include "validation/studies/study.h"

#include "fathom/numeric/errors.h"
#include "validation/studies/clipping.h"
#include "validation/studies/depth_resolution.h"
#include "validation/studies/indistinguishable.h"
#include "validation/studies/z_fighting.h"

namespace fathom::studies {

const std::vector<Study>& all_studies() {
  static const std::vector<Study> studies{
      {"clipping", "Sutherland-Hodgman's bridging edges on concave polygons, and their cures",
       study_clipping},
      {"depth-resolution", "The step of every depth format against depth, near and far",
       study_depth_resolution},
      {"indistinguishable",
       "Which of many depths become equal or swap in a pipeline, after Reed, Upchurch and Desbrun",
       study_indistinguishable},
      {"z-fighting", "Where two nearly coplanar surfaces fight, by distance, separation and format",
       study_z_fighting}};
  return studies;
}

const Study& study_named(const std::string& name) {
  std::string names;
  for (const Study& study : all_studies()) {
    if (study.name == name) return study;
    names += (names.empty() ? "" : ", ") + std::string(study.name);
  }
  throw UsageError("there is no study '" + name + "'; there are " + names);
}

}  // namespace fathom::studies
