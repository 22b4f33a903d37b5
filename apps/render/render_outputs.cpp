#include "apps/render/render_outputs.h"

#include <unordered_set>

#include "apps/options/output_arguments.h"
#include "fathom/failures/errors.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

/// Names of one pattern are different; those of two patterns are checked here.
void require_different(std::unordered_set<std::string>& all,
                       const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (all.insert(name).second) continue;
    throw UsageError("-o: two outputs would both be written as " + text::printable(name));
  }
}

}  // namespace

RenderOutputs::RenderOutputs(const RenderArguments& arguments, const std::vector<Camera>& cameras)
    : cameras_(arguments.save_camera), statistics_(arguments.statistics) {
  const std::vector<std::string> patterns = arguments.patterns();
  std::unordered_set<std::string> all;
  for (std::size_t number = 0; number < patterns.size(); ++number) {
    Maps& maps = maps_.emplace_back();
    maps.names = names_of_outputs("-o", patterns[number], cameras);
    require_different(all, maps.names);
    for (const std::string& name : maps.names) maps.files.emplace_back(name);
    const StorageOptions storage = arguments.storage_of(number);
    if (!storage.png_sidecar) continue;
    for (const std::string& name : maps.names) maps.sidecars.emplace_back(storage.sidecar_of(name));
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
  for (Maps& maps : maps_) {
    for (OutputFile& output : maps.sidecars) files.push_back(&output);
    for (OutputFile& output : maps.files) files.push_back(&output);
  }
  cameras_.print();
  statistics_.print();
  OutputFile::commit_together(files);
}

}  // namespace fathom::app
