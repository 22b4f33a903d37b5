#pragma once

#include <string>

#include "apps/view/packing.h"
#include "apps/view/page.h"

namespace fathom::view {

/// Writes the samples of the pixels of a tile as script elements `PREFIX0END` to `PREFIX4END`, in
/// the order of the pixels: Z, ZBack, area, A and id.
void write_samples(const DeepMap& deep, const TilePlace& tile, const std::string& prefix,
                   const std::string& end, const Sink& sink);

}  // namespace fathom::view
