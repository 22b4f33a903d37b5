#include "validation/peers/built_in_peers.h"

#include <cmath>
#include <cstdlib>

#include "fathom/numeric/errors.h"
#include "validation/embree/embree_tracer.h"
#include "validation/opengl/opengl_renderer.h"
#include "validation/vtk/vtk_depth_maps.h"

namespace fathom::validation {
namespace {

/// "unorm24", "float32 reversed", "unorm16 offset 4", "unorm24 4 samples".
OpenGlDepth opengl_depth(const std::string& variant) {
  OpenGlDepth depth;
  std::vector<std::string> words(1);
  for (const char c : variant) {
    if (c == ' ') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  depth.storage = storage_named(words[0]);
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] == "reversed") depth.reversed = true;
    if (words[i] == "offset") depth.offset_units = std::atoi(words[i + 1].c_str());
    if (words[i] == "samples") depth.samples = std::atoi(words[i - 1].c_str());
  }
  return depth;
}

DrawnMap draw_embree(const ValidationScene& scene, bool robust) {
  EmbreeTracer tracer(world_mesh(scene.scene), {.robust = robust});
  tracer.build();
  std::vector<float> depths;
  tracer.trace(scene.camera, RayStream::packets, depths);
  DrawnMap drawn{.version = EmbreeTracer::description()};
  drawn.map.width = scene.camera.width;
  drawn.map.height = scene.camera.height;
  drawn.map.depths.assign(depths.begin(), depths.end());
  drawn.model.name = "ray in binary32";
  drawn.model.kind = RendererModel::Kind::ray;
  drawn.model.watertight = false;
  return drawn;
}

}  // namespace

DrawnMap draw_built_in(const Peer& peer, const ValidationScene& scene) {
  if (peer.renderer == "embree") return draw_embree(scene, peer.variant == "robust");
  const WorldMesh mesh = world_mesh(scene.scene);
  if (peer.renderer == "opengl") return draw_opengl(mesh, scene.camera, opengl_depth(peer.variant));
  if (peer.renderer == "vtk") return draw_vtk(mesh, scene.camera, peer.variant);
  throw UsageError("there is no renderer '" + peer.renderer + "'");
}

std::vector<int> built_in_samples() {
  return offered_samples();
}

}  // namespace fathom::validation
