#include "fathom/numeric/errors.h"
#include "validation/peers/built_in_peers.h"

namespace fathom::validation {

DrawnMap draw_built_in(const Peer& peer, const ValidationScene&) {
  throw InputError(
      peer.renderer +
      " is not built in: 'scripts/fathom validate' installs it (scripts/install-dependencies "
      "peers) and builds with it (-DFATHOM_PEERS=ON)");
}

std::vector<int> built_in_samples() {
  return {};
}

}  // namespace fathom::validation
