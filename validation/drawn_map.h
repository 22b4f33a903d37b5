#pragma once

#include <string>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"

namespace fathom::validation {

/// What another renderer drew, and what is known about how it did so.
struct DrawnMap {
  attribution::OtherMap map;
  attribution::RendererModel model;
  /// Its version and the driver or machine it runs on.
  std::string version;
};

}  // namespace fathom::validation
