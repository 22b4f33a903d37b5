#include "validation/peers/built_in_peers.h"
#include "validation/peers/not_built_in.h"

namespace fathom::validation {
DrawnMap draw_built_in(const VtkVariant& /*variant*/, const ValidationScene& /*scene*/) {
  refuse_absent(name_of(Renderer::vtk));
}

DrawnMap draw_built_in(const OpenGlVariant& /*variant*/, const ValidationScene& /*scene*/) {
  refuse_absent(name_of(Renderer::opengl));
}

DrawnMap draw_built_in(const EmbreeVariant& /*variant*/, const ValidationScene& /*scene*/) {
  refuse_absent(name_of(Renderer::embree));
}

GreyPicture draw_built_in_colours(const LitScene& /*scene*/, VtkShading /*shading*/) {
  refuse_absent(name_of(Renderer::vtk));
}

std::vector<int> built_in_samples(Driver /*driver*/) {
  return {};
}

}  // namespace fathom::validation
