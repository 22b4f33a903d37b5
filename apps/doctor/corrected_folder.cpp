#include "apps/doctor/corrected_folder.h"

#include <algorithm>
#include <utility>

#include "apps/jobs/manifest.h"
#include "apps/options/output_arguments.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/image/map_files.h"

namespace fathom::app {

CorrectedFolder::CorrectedFolder(std::filesystem::path folder, const std::vector<Camera>& cameras,
                                 bool overwrites, const Console& console)
    : folder_(std::move(folder)) {
  const bool is_named =
      std::ranges::none_of(cameras, [](const Camera& camera) { return camera.name.empty(); });
  names_ = names_of_outputs("-o", is_named ? "depth/{stem}.exr" : "depth/{index:06}.exr", cameras);
  names_.emplace_back("cameras.json");
  Warnings warnings;
  const ManifestContent made = read_manifests(folder_, warnings);
  console.warn(warnings);
  for (const std::string& name : names_) {
    if (!overwrites && !made.owned.contains(name)) require_absent(folder_ / name);
    files_.push_back(std::make_unique<OutputFile>(folder_ / name));
  }
}

void CorrectedFolder::write_depth(std::size_t camera, const DepthMap& map) const {
  const std::string name = (folder_ / names_[camera]).string();
  files_[camera]->write(encode_map(map, name, MapFormat::exr));
}

void CorrectedFolder::finish(const std::vector<Camera>& cameras) {
  files_.back()->write(to_json(cameras) + "\n");
  std::vector<OutputFile*> outputs;
  outputs.reserve(files_.size());
  for (const auto& file : files_) outputs.push_back(file.get());
  OutputFile::commit_together(outputs);
  Manifest(folder_, {}).announce(names_);
}

}  // namespace fathom::app
