#include "apps/dataset/nerf_list.h"

#include <nlohmann/json.hpp>
#include <unordered_map>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/text/parse_json.h"

namespace fathom::app {

using Json = nlohmann::ordered_json;

std::string transforms_with_depths(const std::string& file, const std::vector<Camera>& cameras,
                                   const std::vector<std::string>& depths) {
  std::unordered_map<std::string, std::string> depth_of;
  for (std::size_t i = 0; i < cameras.size(); ++i) depth_of[cameras[i].name] = depths[i];
  Json json;
  try {
    json = text::parse_json<Json>(files::InputFile(file).text());
    Json frames = Json::array();
    std::size_t number = 0;
    for (Json& frame : json.at("frames")) {
      const std::string name = frame.value("file_path", std::to_string(number++));
      const auto found = depth_of.find(name);
      if (found == depth_of.end()) continue;
      frame["depth_file_path"] = found->second;
      frames.push_back(std::move(frame));
    }
    json["frames"] = std::move(frames);
    json["depth_unit_scale_factor"] = 0.001;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file + ": has changed while it was in use: " + error.what());
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace fathom::app
