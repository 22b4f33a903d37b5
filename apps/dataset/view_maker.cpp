#include "apps/dataset/view_maker.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "apps/options/map_arguments.h"
#include "apps/render/render_limits.h"
#include "apps/shell/failures.h"
#include "fathom/camera/camera_files.h"
#include "fathom/render.h"

namespace fathom::app {
namespace {

/// What decides about the bytes of all maps: their sources, and how they are rendered and stored.
std::string description_of(const Scene& scene, const MapPlan& plan) {
  std::string text = "maps 1\n";
  for (const Source& source : scene.sources) {
    text += fmt::format("source {} {} {}\n", source.sha256, source.reader, source.path);
  }
  const RenderOptions& rendering = plan.rendering;
  text +=
      fmt::format("channels {} cull {} depth {} {:a} normals {}\n", text_of(rendering.channels),
                  static_cast<int>(rendering.cull), static_cast<int>(rendering.depth_encoding.type),
                  rendering.depth_encoding.scale, static_cast<int>(rendering.normals));
  text += fmt::format("format {} compression {}", static_cast<int>(plan.format),
                      static_cast<int>(plan.writing.compression));
  if (rendering.depth_encoding.beyond_is_none) text += " beyond none";
  if (plan.storage.background) text += fmt::format(" background {:a}", *plan.storage.background);
  for (const ChannelName& name : plan.storage.channel_names) {
    text += fmt::format(" {}={}", name.channel, name.in_file);
  }
  return text + "\n";
}

}  // namespace

ViewMaker::ViewMaker(Scene scene, std::vector<Camera> cameras, MapPlan plan)
    : scene_(std::move(scene)), cameras_(std::move(cameras)), plan_(std::move(plan)) {
  inputs_ = description_of(scene_, plan_);
  plan_.rendering.kept = &memory_;
  check_cameras(cameras_, plan_, "a map");
}

std::string ViewMaker::inputs_of(std::size_t camera) const {
  return inputs_ + to_json(cameras_[camera]);
}

std::size_t ViewMaker::memory_of(std::size_t camera) const {
  const std::size_t of_value = plan_.rendering.depth_encoding.type == DepthEncoding::Type::binary64
                                   ? sizeof(double)
                                   : sizeof(float);
  return std::size_t{cameras_[camera].width} * cameras_[camera].height * of_value *
         count_parts(plan_.rendering.channels);
}

std::shared_ptr<const DepthMap> ViewMaker::make(std::size_t camera, const std::string& name) {
  RenderStatistics statistics;
  RenderOptions options = plan_.rendering;
  options.statistics = &statistics;
  DepthMap map = about_output(name, [&] { return render(scene_, cameras_[camera], options); });
  warnings_.note(scene_, cameras_[camera], statistics.pixels_with_surface);
  codes_beyond_.note(map);
  return std::make_shared<const DepthMap>(
      plan_.storage.dressed(std::move(map), name, std::numeric_limits<double>::infinity()));
}

void ViewMaker::warn(const Console& console) const {
  warnings_.tell(console);
  codes_beyond_.tell(console);
}

}  // namespace fathom::app
