#include "fathom/image/depth_map.h"

#include <algorithm>
#include <utility>

namespace fathom {

const ImageChannel* DepthMap::find(const std::string& name) const {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const ImageChannel& c) { return c.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

ImageChannel* DepthMap::find(const std::string& name) {
  return const_cast<ImageChannel*>(std::as_const(*this).find(name));
}

}  // namespace fathom
