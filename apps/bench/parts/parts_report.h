#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/bench/machine.h"
#include "apps/bench/parts/exact_picture.h"
#include "apps/bench/parts/ideas.h"

namespace fathom::bench {

/// What each idea brought on one scene.
struct PartsOfScene {
  std::string scene;
  std::uint64_t triangles = 0;
  std::uint32_t width = 0, height = 0;
  std::vector<IdeaTimes> ideas;
  /// Names of ideas that mean nothing for this scene, each with the reason.
  std::vector<std::string> left_out;
};

/// "sphere-20k: 20000 triangles, 1280x720", a line.
std::string heading(const PartsOfScene& parts);
/// A table: a row for each variant with its median and least time in milliseconds, how many times
/// as fast as its plain variant it is ("1" where it is one), and what it counted. Ends with an
/// empty line.
std::string table(const IdeaTimes& idea);
/// A table of the pixels by both rules. Ends with an empty line.
std::string table(const std::vector<RuleCounts>& rules);

/// {"machine": …, "results": [ … ], "left_out": [ … ], "closed_edges": [ … ]}; one result for each
/// variant. Ends without a newline.
std::string to_json(const Machine& machine, const std::vector<PartsOfScene>& parts,
                    const std::vector<RuleCounts>& rules);

}  // namespace fathom::bench
