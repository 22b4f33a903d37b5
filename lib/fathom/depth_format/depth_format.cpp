#include "fathom/depth_format/depth_format.h"

#include <cmath>
#include <cstdio>

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"

namespace fathom {
namespace {

constexpr std::string_view mapping_names[] = {
    "standard", "reversed", "infinite", "reversed-infinite", "opengl",
    "linear",   "w",        "log",      "log-ulrich"};
constexpr std::string_view storage_names[] = {"unorm16", "unorm24", "unorm32",
                                              "float16", "float32", "float64"};

template <std::size_t N>
std::string list(const std::string_view (&names)[N]) {
  std::string text;
  for (const std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

template <std::size_t N>
std::size_t index_of(const std::string_view (&names)[N], std::string_view name, const char* what) {
  for (std::size_t i = 0; i < N; ++i) {
    if (names[i] == name) return i;
  }
  throw UnknownName(
      "there is no " + std::string(what) + " '" + std::string(name) + "'; there are " + list(names),
      std::string(name), {std::begin(names), std::end(names)});
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
                     list(storage_names));
  }
  if (!(format.c > 0) || std::isinf(format.c)) {
    throw UsageError("C = " + text_of(format.c) + " is not a positive number");
  }
  if (format.c != 1 && format.mapping != Mapping::log) {
    throw UsageError("mapping " + std::string(name_of(format.mapping)) +
                     " has no constant C; log alone has one");
  }
}

std::string_view name_of(Mapping mapping) {
  return mapping_names[static_cast<std::size_t>(mapping)];
}

std::string_view name_of(Storage storage) {
  return storage_names[static_cast<std::size_t>(storage)];
}

Mapping mapping_named(std::string_view name) {
  return static_cast<Mapping>(index_of(mapping_names, name, "mapping"));
}

Storage storage_named(std::string_view name) {
  return static_cast<Storage>(index_of(storage_names, name, "storage"));
}

}  // namespace fathom
