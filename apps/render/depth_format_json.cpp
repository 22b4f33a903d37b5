#include "apps/render/depth_format_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace fathom::app {

nlohmann::ordered_json json_of(const DepthFormat& format) {
  using Json = nlohmann::ordered_json;
  Json json{{"mapping", name_of(format.mapping)},
            {"storage", name_of(format.storage)},
            {"near", format.near},
            {"far", std::isfinite(format.far) ? Json(format.far) : Json(nullptr)}};
  if (format.mapping == Mapping::log) json["c"] = format.c;
  return json;
}

}  // namespace fathom::app
