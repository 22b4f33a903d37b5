#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/study/study_scene.h"
#include "fathom/depth_buffer/depth_buffer.h"
#include "fathom/depth_format/certified_format.h"
#include "fathom/depth_format/depth_bias.h"

/// All surfaces behind the samples of an image, and their depths in a depth buffer.
namespace fathom::studies {

/// A triangle that counts at a sample, with its depth there, exact and rounded.
struct Layer {
  std::uint32_t number;
  Ratio depth;
  double rounded;
};

/// The layers of one sample, in the order of the triangles' numbers, and the visible one.
struct LayeredSample {
  std::uint32_t column, row;
  std::vector<Layer> layers;
  std::size_t visible;
};

/// The samples at pixel centres behind which there are at least two layers; row by row.
std::vector<LayeredSample> layered_samples(const SceneView& view);

/// The stored value of a layer: by bounds from the rounded depth, or else from the exact one.
StoredDepth encode_layer(const CertifiedFormat& format, const Layer& layer);

/// Results of a format for surfaces behind other surfaces, over pairs of a visible surface in a
/// class of distances and another surface.
struct LostSeparation {
  double distance;       ///< upper end of the class, a factor of √2 beyond the last
  double greatest_lost;  ///< greatest separation of a pair that is stored as equal; or 0
  /// The width of the bin at the upper end: no lost separation is greater.
  double predicted;
};
std::vector<LostSeparation> lost_separations(const std::vector<LayeredSample>& samples,
                                             const DepthFormat& format);

/// Offsets for triangles whose number is `first` or greater.
struct OffsetLayers {
  const SceneView& view;
  const std::vector<LayeredSample>& samples;
  DepthFormat format;
  std::uint32_t first;
  /// f of each layer of each sample, rounded to binary64.
  std::vector<std::vector<double>> window_depths;

  OffsetLayers(const SceneView& of, const std::vector<LayeredSample>& seen,
               const DepthFormat& stored, std::uint32_t first_number);
};
struct OffsetCount {
  DepthBias bias;
  /// Samples at which a wrong triangle wins: an offset triangle that should be hidden, or any other
  /// triangle.
  std::size_t shows_through = 0, fights = 0;
};
/// The depth test with polygon offset (depth_bias.h), ideal model, mapping standard, perspective.
OffsetCount count_with_offset(const OffsetLayers& layers, const DepthBias& bias);

// Z-fighting over the image of a scene, ideal model.

struct SceneFights {
  DepthFormat format;
  std::uint64_t surface_pixels = 0, fighting = 0;
  /// Greatest |decoded − exact| depth.
  double greatest_error = 0;
  [[nodiscard]] double share() const {
    return surface_pixels == 0
               ? 0
               : static_cast<double>(fighting) / static_cast<double>(surface_pixels);
  }
};

/// The visible surfaces in a format; `visible` has Z and id.
struct BufferedScene {
  SceneFights fights;
  /// With the channels of depth_buffer.h.
  DepthMap map;
};
BufferedScene buffer_scene(const SceneView& view, const DepthMap& visible,
                           const DepthFormat& format);

/// A picture, and the command that draws it in the folder of the page.
struct FightPicture {
  StudyFile png;
  std::string command;
};
/// fights-NAME: the fighting pixels; error-NAME: the errors of decoded depths. The commands read
/// these files of the scene and its camera.
std::vector<FightPicture> pictures_of(const std::string& name, const BufferedScene& buffered,
                                      const std::string& scene, const std::string& camera);

/// NAME.json
StudyFile camera_file(const std::string& name, const Camera& camera);

}  // namespace fathom::studies
