#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "validation/colour/colour_comparison.h"
#include "validation/vtk/drawn_by_vtk.h"

/// A picture of the pipeline and the picture of VTK that it is compared with.
namespace fathom::app {

struct ColourPair {
  const char* name;
  const char* file;  ///< the end of the name of its picture
  /// With highlights or without.
  bool glossy;
  pipeline::Shading ours;
  validation::LightModel our_model;
  validation::VtkShading theirs;
  validation::LightModel their_model;
};

/// Pairs with equal formulas first.
inline constexpr std::array colour_pairs{
    // Without highlights, which ours has from the centre of the face and VTK's from each fragment.
    ColourPair{"flat, VTK flat, matte", "flat-matte", false, pipeline::Shading::flat,
               validation::LightModel::face, validation::VtkShading::flat,
               validation::LightModel::derived_normal},
    ColourPair{"phong, VTK Phong", "phong", true, pipeline::Shading::phong,
               validation::LightModel::interpolated_normal, validation::VtkShading::phong,
               validation::LightModel::interpolated_normal},
    ColourPair{"phong, VTK Gouraud", "phong-beside-gouraud", true, pipeline::Shading::phong,
               validation::LightModel::interpolated_normal, validation::VtkShading::gouraud,
               validation::LightModel::interpolated_normal},
    // Different formulas.
    ColourPair{"flat, VTK flat, glossy", "flat", true, pipeline::Shading::flat,
               validation::LightModel::face, validation::VtkShading::flat,
               validation::LightModel::derived_normal},
    ColourPair{"gouraud, VTK Gouraud", "gouraud", true, pipeline::Shading::gouraud,
               validation::LightModel::corners, validation::VtkShading::gouraud,
               validation::LightModel::interpolated_normal}};

/// Of a pair's surfaces. Highlights are Phong's, as VTK's are.
pipeline::Material material_of(const ColourPair& pair);

/// The pipeline's picture, in binary64 and with its usual grid.
validation::GreyPicture drawn_by_pipeline(const validation::LitScene& scene,
                                          pipeline::Shading shading);

/// A scene and a pair of pictures of it, or the reason why they are missing.
struct ColourCase {
  std::string scene;
  const ColourPair* pair = nullptr;
  std::string failure;
  std::optional<validation::GreyPicture> ours, theirs;
  validation::ColourComparison found;
};

/// Prints a line for each case and, where `out` is not empty, writes colours.json and a picture for
/// each case to that folder, which exists: ours on the left, VTK's on the right. Returns the exit
/// status.
int report_colours(const std::vector<ColourCase>& cases, const std::string& out);

}  // namespace fathom::app
