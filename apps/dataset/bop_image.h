#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/dataset/dataset_command.h"
#include "apps/jobs/job.h"
#include "fathom/fast/render_memory.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/bop_scene.h"

namespace fathom::app {

/// The files of an image of BOP: depth/000017.png, then for each instance mask/000017_000002.png
/// and mask_visib/000017_000002.png.
std::vector<std::string> files_of(const BopImage& image);

struct BopImageOptions {
  Cull cull = Cull::none;
  int threads = 0;
  /// Exact areas beside the counts.
  bool areas = false;
  /// Depths beyond the last code are stored as 0.
  bool beyond_is_none = false;
};

/// Makes the files of images, and as facts what scene_gt_info.json has of each instance:
///   px_count_all     pixels of its silhouette alone, in an image three times as wide and as high
///                    around the image, as bop_toolkit's calc_gt_info.py has it
///   px_count_valid   those of them within the image at which the depth image has a depth
///   px_count_visib   those at which it is the nearest surface
///   visib_fract      px_count_visib / px_count_all, 0 where that is 0
///   bbox_obj         of px_count_all, bbox_visib of px_count_visib: x, y, and the differences of
///                    the last and the first column and row; −1 for all where no pixel is visible
/// and with areas, in pixels:
///   area_all, area_visib   of the silhouette, within that larger image, and of what is visible;
///                          each the exact number rounded once
///   visib_area_fract       the quotient of these two rounded numbers, rounded; 0 where the first
///                          is 0
/// Exact    all counts: a pixel is covered if its centre is.
class BopImageMaker {
 public:
  BopImageMaker(BopModels& models, BopImageOptions options) : models_(models), options_(options) {}

  /// Fails    OutputError where a depth does not fit 16 bits of the image's depth_scale, unless
  ///          those beyond are none.
  [[nodiscard]] Result make(const BopImage& image, const std::filesystem::path& folder);
  /// Warns of depths that lie beyond their codes, in the images that have been made.
  void warn(const Console& console) const { codes_beyond_.tell(console); }

 private:
  struct Silhouette;
  [[nodiscard]] Silhouette silhouette_of(const BopImage& image, std::size_t instance);
  [[nodiscard]] RenderOptions rendering(std::vector<Channel> channels) const;

  BopModels& models_;
  BopImageOptions options_;
  RenderMemory memory_, memory_of_silhouettes_;
  CodesBeyond codes_beyond_;
};

}  // namespace fathom::app
