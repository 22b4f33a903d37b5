#pragma once

#include <memory>

#include "fathom/image/depth_map.h"

namespace fathom::python {

/// The map behind Python's Map: all of it but, where Python has taken them as arrays, its channels.
using SharedMap = std::shared_ptr<DepthMap>;

}  // namespace fathom::python
