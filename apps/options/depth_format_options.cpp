#include "apps/options/depth_format_options.h"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"

namespace fathom::app {

namespace {

template <class Values, class Value>
std::string list_with_default(const Values& values, Value standard) {
  std::vector<std::string> names;
  for (const auto value : values)
    names.push_back(std::string(name_of(value)) + (value == standard ? " (default)" : ""));
  return joined(names, " or ");
}

}  // namespace

std::string list_of_mappings() {
  return list_with_default(all_mappings, DepthFormat{}.mapping);
}

std::string list_of_storages() {
  return list_with_default(all_storages, DepthFormat{}.storage);
}

void DepthFormatOptions::add_to(Command& command) {
  command.option("--mapping", "NAME", into(mapping, mapping_named),
                 "Mapping from depth to stored value: " + list_of_mappings());
  command.option("--storage", "NAME", into(storage, storage_named),
                 "Storage: " + list_of_storages() +
                     "; also as D24S8, GL_DEPTH_COMPONENT24, VK_FORMAT_D32_SFLOAT, …");
  command.option("--near", "D", into(near, parse_number), "Least depth").required();
  command.option("--far", "D", into(far, parse_number_or_infinity),
                 "Greatest depth; inf is the default of infinite and reversed-infinite");
  command.option("--c", "C", into(c, parse_number), "Constant C of mapping log (default 1)");
}

DepthFormat DepthFormatOptions::format() const {
  DepthFormat format{.mapping = mapping, .storage = storage, .near = near};
  if (far) {
    format.far = *far;
  } else if (takes_infinite_far(mapping)) {
    format.far = std::numeric_limits<double>::infinity();
  } else {
    throw UsageError("--far is needed by mapping " + std::string(name_of(mapping)));
  }
  require_constant_of(mapping, c);
  format.c = c.value_or(format.c);
  require_meaningful(format);
  return format;
}

void require_constant_of(Mapping mapping, const std::optional<double>& c) {
  if (c && !(*c > 0)) {
    throw UsageError(
        fmt::format("--c: {} is not positive; expected the constant C of --mapping log, "
                    "e.g. 1",
                    *c));
  }
  if (!c || mapping == Mapping::log) return;
  throw UsageError("--c: mapping " + std::string(name_of(mapping)) +
                   " has no constant C; --c is only for --mapping log");
}

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
