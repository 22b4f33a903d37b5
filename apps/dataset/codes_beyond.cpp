#include "apps/dataset/codes_beyond.h"

#include <fmt/format.h>

#include "fathom/text/counted.h"

namespace fathom::app {

void CodesBeyond::note(const DepthMap& map) {
  if (map.codes_beyond.value_or(0) == 0) return;
  pixels_ += *map.codes_beyond;
  ++maps_;
}

void CodesBeyond::tell(const Console& console) const {
  if (pixels_ == 0) return;
  console.warn(fmt::format("{} in {} lie beyond the last code and are stored as 0",
                           text::counted(pixels_, "pixel"), text::counted(maps_, "map")));
}

}  // namespace fathom::app
