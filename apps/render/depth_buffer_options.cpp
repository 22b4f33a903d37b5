#include "apps/render/depth_buffer_options.h"

#include <algorithm>
#include <cmath>

#include "apps/shell/numbers.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {

void DepthBufferArguments::add_to(CLI::App& command) {
  command.add_option("--depth-format", storage_,
                     "Add what a depth buffer would hold, channel Zwindow, and the depth decoded "
                     "from it, Zdecoded; near and far are the camera's. unorm16, unorm24, unorm32: "
                     "the code (UINT); float16, float32: the value (FLOAT); float64: the halves of "
                     "its bits, Zwindow.high and Zwindow.low (UINT)");
  command.add_option("--mapping", mapping_,
                     "Of --depth-format: standard (default), reversed, infinite, "
                     "reversed-infinite, opengl, linear, w, log or log-ulrich");
  command.add_option("--c", c_, "Of --mapping log: the constant C (default 1)");
  command.add_flag("--against-exact", against_exact_,
                   "Of --depth-format: add Zerror, Zdecoded minus the exact depth; Zwinner, the "
                   "triangle that the format lets win; Zfight, 1 where that is the wrong one");
}

void DepthBufferArguments::check() const {
  if (!wanted()) {
    if (mapping_.empty() && c_.empty() && !against_exact_) return;
    throw UsageError("--mapping, --c and --against-exact belong to --depth-format");
  }
  storage_named(storage_);
  const Mapping mapping = mapping_.empty() ? Mapping::standard : mapping_named(mapping_);
  if (!c_.empty() && mapping != Mapping::log) {
    throw UsageError("--c: mapping " + std::string(name_of(mapping)) +
                     " has no constant C; log alone has one");
  }
  if (!c_.empty()) (void)parse_number("--c", c_);
}

void DepthBufferArguments::prepare(RenderOptions& options) {
  if (!wanted()) return;
  const auto& channels = options.channels;
  added_id_ = std::find(channels.begin(), channels.end(), Channel::id) == channels.end();
  if (added_id_) options.channels.push_back(Channel::id);
}

void DepthBufferArguments::drop_added(DepthMap& map) const {
  if (added_id_) std::erase_if(map.channels, [](const auto& c) { return c.name == "id"; });
}

DepthFormat DepthBufferArguments::format(const Camera& camera) const {
  const Mapping mapping = mapping_.empty() ? Mapping::standard : mapping_named(mapping_);
  const double c = c_.empty() ? 1 : parse_number("--c", c_);
  return depth_format_of(camera, mapping, storage_named(storage_), c);
}

nlohmann::ordered_json DepthBufferArguments::add(DepthMap& map, const TriangleSource& triangles,
                                                 const Camera& camera,
                                                 const RenderOptions& options) const {
  const DepthFormat f = format(camera);
  const DepthBufferStatistics seen =
      add_depth_buffer(map, triangles, camera, {f, against_exact_, options});
  nlohmann::ordered_json description{
      {"mapping", name_of(f.mapping)}, {"storage", name_of(f.storage)}, {"near", f.near}};
  if (std::isfinite(f.far)) {
    description["far"] = f.far;
  } else {
    description["far"] = nullptr;
  }
  if (f.mapping == Mapping::log) description["c"] = f.c;
  map.texts["fathom.depth_format"] = description.dump();
  description["encoded"] = {{"binary64", seen.by_binary64},
                            {"double_words", seen.by_double_words},
                            {"exact", seen.by_exact_numbers}};
  if (against_exact_) description["fighting_pixels"] = seen.fighting;
  return description;
}

}  // namespace fathom::app
