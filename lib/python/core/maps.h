#pragma once

#include <memory>
#include <string>

#include "fathom/image/depth_map.h"
#include "fathom/image/map_files.h"

namespace fathom::python {

/// The map behind Python's Map: all of it but, where Python has taken them as arrays, its channels.
using SharedMap = std::shared_ptr<DepthMap>;

/// Fails    UsageError, naming those that there are.
Compression compression_named(const std::string& name);

}  // namespace fathom::python
