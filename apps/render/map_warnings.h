#pragma once

#include <vector>

#include "apps/shell/console.h"
#include "fathom/image/channel_table.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/options.h"

namespace fathom::app {

/// Of scenes that show nothing or less than one would think.
void warn_of(const RenderStatistics& statistics, const Console& console);

/// Of channels that will show nothing but that there is none.
void warn_of_missing_segments(const TriangleSource& triangles, const std::vector<Channel>& channels,
                              const Console& console);

}  // namespace fathom::app
