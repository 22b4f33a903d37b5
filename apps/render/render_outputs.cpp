#include "apps/render/render_outputs.h"

#include "apps/options/output_names.h"

namespace fathom::app {

RenderOutputs::RenderOutputs(const RenderArguments& arguments, const std::vector<Camera>& cameras)
    : names_(names_of_outputs("-o", arguments.output, cameras)),
      maps_(names_.begin(), names_.end()),
      cameras_(arguments.save_camera),
      statistics_(arguments.statistics) {
  if (arguments.storage.png_sidecar) {
    for (const std::string& name : names_)
      sidecars_.emplace_back(arguments.storage.sidecar_of(name));
  }
  if (arguments.image.empty()) return;
  for (const std::string& name : names_of_outputs("--image", arguments.image, cameras)) {
    pictures_.emplace_back(name);
  }
}

void RenderOutputs::commit() {
  std::vector<OutputFile*> files;
  for (TextOutput* text : {&cameras_, &statistics_}) {
    if (text->file() != nullptr) files.push_back(text->file());
  }
  for (OutputFile& output : pictures_) files.push_back(&output);
  for (OutputFile& output : sidecars_) files.push_back(&output);
  for (OutputFile& output : maps_) files.push_back(&output);
  cameras_.print();
  statistics_.print();
  OutputFile::commit_together(files);
}

}  // namespace fathom::app
