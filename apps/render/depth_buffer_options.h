#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "fathom/depth_buffer/depth_buffer.h"

namespace fathom::app {

/// `--depth-format --mapping --c --against-exact` of `render`: the channels of a depth buffer.
class DepthBufferArguments {
 public:
  void add_to(CLI::App& command);
  [[nodiscard]] bool wanted() const { return !storage_.empty(); }
  /// Names, and options that belong to others. Fails with UsageError.
  void check() const;
  /// Asks for what the depth buffer needs of a rendered map; drop_added() takes it away again.
  void prepare(RenderOptions& options);
  void drop_added(DepthMap& map) const;
  /// Channels that add() adds, at most.
  [[nodiscard]] double channels() const { return wanted() ? (against_exact_ ? 6 : 3) : 0; }
  /// Fails    UsageError where the camera's near and far do not fit the mapping.
  [[nodiscard]] DepthFormat format(const Camera& camera) const;
  /// Adds the channels and tells what was seen.
  nlohmann::ordered_json add(DepthMap& map, const TriangleSource& triangles, const Camera& camera,
                             const RenderOptions& options) const;

 private:
  std::string storage_, mapping_, c_;
  bool against_exact_ = false, added_id_ = false;
};

}  // namespace fathom::app
