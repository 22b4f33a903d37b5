#pragma once

#include <string>

#include "fathom/failures/errors.h"

namespace fathom::validation {

/// Refuses a renderer or an engine of FATHOM_PEERS where this build has none.
[[noreturn]] inline void refuse_absent(const std::string& name) {
  throw InputError(name +
                   " is not built in: 'scripts/fathom validate' in a clone of Fathom installs it "
                   "(scripts/install-dependencies "
                   "peers) and builds with it (-DFATHOM_PEERS=ON)");
}

}  // namespace fathom::validation
