#pragma once

#include <string>

#include "apps/shell/console.h"
#include "fathom/camera/camera.h"
#include "fathom/image/convert.h"
#include "fathom/image/depth_map.h"
#include "fathom/map_description.h"

namespace fathom::app {

/// The camera of a map: that of the camera file where one is named, else the one that the map
/// carries in `fathom.camera`. `map_file` is named in messages; warnings of the file go to the
/// console.
/// Fails    InputError where there is no camera, or none for this map; UsageError for a path.
Camera camera_for(const DepthMap& map, const std::string& map_file, const std::string& camera_file,
                  const Console& console);
/// The same as conversions of maps need it.
MapView view_for(const DepthMap& map, const std::string& map_file, const std::string& camera_file,
                 const Console& console);

}  // namespace fathom::app
