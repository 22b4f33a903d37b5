#include "fathom/depth_format/depth_format.h"

#include <cmath>
#include <cstdio>
#include <ranges>
#include <string>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"

namespace fathom {
namespace {

constexpr std::string_view mapping_names[] = {
    "standard", "reversed", "infinite", "reversed-infinite", "opengl",
    "linear",   "w",        "log",      "log-ulrich"};
constexpr std::string_view storage_names[] = {"unorm16", "unorm24", "unorm32",
                                              "float16", "float32", "float64"};

template <class Values>
std::ranges::range_value_t<Values> required(const Values& values, std::string_view name,
                                            const std::string& what) {
  if (const auto value = value_named(values, name)) return *value;
  const std::vector<std::string> names = names_of(values);
  throw UnknownName(
      "there is no " + what + " '" + std::string(name) + "'; there are " + joined(names, ", "),
      std::string(name), names);
}

std::string text_of(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

}  // namespace

void require_meaningful(const DepthFormat& format) {
  if (!(format.near > 0) || std::isinf(format.near)) {
    throw UsageError("near = " + text_of(format.near) + " is not a positive number");
  }
  if (!(format.far > format.near)) {
    throw UsageError("far = " + text_of(format.far) +
                     " is not greater than near = " + text_of(format.near));
  }
  if (std::isinf(format.far) && !takes_infinite_far(format.mapping)) {
    throw UsageError("mapping " + std::string(name_of(format.mapping)) +
                     " needs a finite far; with far = inf there are infinite and "
                     "reversed-infinite, each with the storages " +
                     joined(names_of(all_storages), ", "));
  }
  if (!(format.c > 0) || std::isinf(format.c)) {
    throw UsageError("C = " + text_of(format.c) + " is not a positive number");
  }
  if (format.c != 1 && format.mapping != Mapping::log) {
    throw UsageError("mapping " + std::string(name_of(format.mapping)) +
                     " has no constant C; only log has one");
  }
}

std::string_view name_of(Mapping mapping) {
  return mapping_names[static_cast<std::size_t>(mapping)];
}

std::string_view name_of(Storage storage) {
  return storage_names[static_cast<std::size_t>(storage)];
}

Mapping mapping_named(std::string_view name) {
  return required(all_mappings, name, "mapping");
}

Storage storage_named(std::string_view name) {
  return required(all_storages, name, "storage");
}

}  // namespace fathom
