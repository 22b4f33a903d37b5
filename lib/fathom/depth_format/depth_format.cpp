#include "fathom/depth_format/depth_format.h"

#include <charconv>
#include <cmath>
#include <ranges>
#include <span>
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

/// What graphics interfaces and people call them.
constexpr OtherName other_mapping_names[] = {{"direct3d", "standard"},
                                             {"d3d", "standard"},
                                             {"vulkan", "standard"},
                                             {"metal", "standard"},
                                             {"webgpu", "standard"},
                                             {"perspective", "standard"},
                                             {"gl", "opengl"},
                                             {"inversez", "reversed"},
                                             {"reverse", "reversed"},
                                             {"infinitereversed", "reversed-infinite"},
                                             {"wbuffer", "w"},
                                             {"logarithmic", "log"},
                                             {"infinitefar", "infinite"},
                                             {"infinitereversedz", "reversed-infinite"},
                                             {"reversedzinfinite", "reversed-infinite"}};
constexpr OtherName other_storage_names[] = {{"d16", "unorm16"},
                                             {"d16unorm", "unorm16"},
                                             {"depth16", "unorm16"},
                                             {"depth16unorm", "unorm16"},
                                             {"depthcomponent16", "unorm16"},
                                             {"d24", "unorm24"},
                                             {"d24s8", "unorm24"},
                                             {"d24x8", "unorm24"},
                                             {"x8d24", "unorm24"},
                                             {"d24unorms8uint", "unorm24"},
                                             {"x8d24unormpack32", "unorm24"},
                                             {"depth24", "unorm24"},
                                             {"depth24plus", "unorm24"},
                                             {"depth24stencil8", "unorm24"},
                                             {"depth24plusstencil8", "unorm24"},
                                             {"depthcomponent24", "unorm24"},
                                             {"d32", "unorm32"},
                                             {"d32", "float32"},
                                             {"d32unorm", "unorm32"},
                                             {"depthcomponent32", "unorm32"},
                                             {"d32f", "float32"},
                                             {"d32fs8", "float32"},
                                             {"d32float", "float32"},
                                             {"d32floats8x24uint", "float32"},
                                             {"d32sfloat", "float32"},
                                             {"d32sfloats8uint", "float32"},
                                             {"depth32f", "float32"},
                                             {"depth32float", "float32"},
                                             {"depth32floatstencil8", "float32"},
                                             {"depthcomponent32f", "float32"},
                                             {"single", "float32"},
                                             {"fp32", "float32"},
                                             {"half", "float16"},
                                             {"fp16", "float16"},
                                             {"double", "float64"},
                                             {"fp64", "float64"}};

template <class Values>
std::ranges::range_value_t<Values> required(const Values& values, std::string_view name,
                                            const std::string& what,
                                            std::span<const OtherName> others) {
  if (const auto value = value_named(values, name)) return *value;
  const std::vector<std::string> names = names_of(values);
  throw unknown_name(
      "there is no " + what + " '" + std::string(name) + "'; there are " + joined(names, ", "),
      std::string(name), names, others);
}

std::string text_of(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x, std::chars_format::general).ptr};
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
    std::vector<std::string> names;
    for (const Mapping mapping : all_mappings) {
      if (takes_infinite_far(mapping)) names.emplace_back(name_of(mapping));
    }
    throw UsageError("mapping " + std::string(name_of(format.mapping)) +
                     " needs a finite far; with far = inf there are " + joined(names) +
                     ", each with the storages " + joined(names_of(all_storages), ", "));
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
  return required(all_mappings, name, "mapping", other_mapping_names);
}

Storage storage_named(std::string_view name) {
  const std::string_view own = name_meant_by(name, other_storage_names).value_or(name);
  return required(all_storages, own, "storage", other_storage_names);
}

}  // namespace fathom
