#include "sample_files.h"

#include <nlohmann/json.hpp>

namespace fathom::test {

const std::string square_obj =
    "v -1 -1 2\nv 1 -1 2\nv 1 1 2\nv -1 1 2\n"
    "f 1 2 3\nf 1 3 4\n";

const std::string square_camera =
    R"({"width": 8, "height": 6, "fx": 4, "fy": 4, "cx": 4, "cy": 3, "pixel_centre": 0.5,
 "world_to_camera": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]})";

std::string camera_with(const std::string& key, const std::string& value) {
  nlohmann::json camera = nlohmann::json::parse(square_camera);
  camera.erase(key);
  std::string text = camera.dump();
  text.pop_back();
  return text + ", \"" + key + "\": " + value + "}";
}

}  // namespace fathom::test
