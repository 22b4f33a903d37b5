#pragma once

#include <cstdint>

#include "apps/shell/console.h"
#include "fathom/image/depth_map.h"

namespace fathom::app {

/// Counts the pixels whose depths lie beyond the codes of their maps.
class CodesBeyond {
 public:
  void note(const DepthMap& map);
  /// Warns of them, where there are any.
  void tell(const Console& console) const;

 private:
  std::uint64_t pixels_ = 0, maps_ = 0;
};

}  // namespace fathom::app
