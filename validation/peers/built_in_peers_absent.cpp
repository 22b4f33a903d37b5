#include "fathom/failures/errors.h"
#include "validation/peers/built_in_peers.h"

namespace fathom::validation {
namespace {

[[noreturn]] void refuse(Renderer renderer) {
  throw InputError(name_of(renderer) +
                   " is not built in: 'scripts/fathom validate' in a clone of Fathom installs it "
                   "(scripts/install-dependencies "
                   "peers) and builds with it (-DFATHOM_PEERS=ON)");
}

}  // namespace

DrawnMap draw_built_in(const VtkVariant& /*variant*/, const ValidationScene& /*scene*/) {
  refuse(Renderer::vtk);
}

DrawnMap draw_built_in(const OpenGlVariant& /*variant*/, const ValidationScene& /*scene*/) {
  refuse(Renderer::opengl);
}

DrawnMap draw_built_in(const EmbreeVariant& /*variant*/, const ValidationScene& /*scene*/) {
  refuse(Renderer::embree);
}

GreyPicture draw_built_in_colours(const LitScene& /*scene*/, VtkShading /*shading*/) {
  refuse(Renderer::vtk);
}

std::vector<int> built_in_samples(Driver /*driver*/) {
  return {};
}

}  // namespace fathom::validation
