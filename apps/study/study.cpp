#include "apps/study/study.h"

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"

namespace fathom::studies {

const std::vector<Study>& all_studies() {
  static const std::vector<Study> studies{
      {"antialiasing", "Sample patterns, and every kind of antialiasing, against exact areas", true,
       study_antialiasing},
      {"blending",
       "Transparent surfaces by the order in which they are drawn, against the exact one", false,
       study_blending},
      {"clipping", "Sutherland-Hodgman's bridging edges on concave polygons, and their cures",
       false, study_clipping},
      {"course", "The exercises, the demo and the tables of the textbooks, as pictures and figures",
       false, study_course},
      {"depth-resolution", "The step of every depth format against depth, near and far", false,
       study_depth_resolution},
      {"hidden-surface",
       "Z-buffer, painter's algorithm and others against the exact visible triangle, with costs",
       true, study_hidden_surface},
      {"indistinguishable",
       "Which of many depths become equal or swap in a pipeline, after Reed, Upchurch and Desbrun",
       false, study_indistinguishable},
      {"lens", "OpenCV's and COLMAP's inverses, bent vertices and remapped maps against exact rays",
       true, study_lens},
      {"lines", "How far lines in floating point drift from the exact ones, and what steps cost",
       false, study_lines},
      {"mitigation", "Z-fighting before and after: near plane, polygon offset, other formats", true,
       study_mitigation},
      {"subpixel", "Coverage and depth against the number of subpixel bits", true, study_subpixel},
      {"z-fighting",
       "Where two nearly coplanar surfaces, or those of a scene, fight, by distance and format",
       true, study_z_fighting}};
  return studies;
}

const Study& study_named(const std::string& name) {
  std::string list;
  std::vector<std::string> names;
  for (const Study& study : all_studies()) {
    if (study.name == name) return study;
    list += (list.empty() ? "" : ", ") + std::string(study.name);
    names.emplace_back(study.name);
  }
  throw UnknownName("there is no study '" + name + "'; there are " + list, name, names);
}

}  // namespace fathom::studies
