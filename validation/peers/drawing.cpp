#include "validation/peers/drawing.h"

#include <exception>

#include "fathom/numeric/errors.h"
#include "validation/bench/in_child.h"
#include "validation/blender/blender_renderer.h"
#include "validation/peers/built_in_peers.h"

namespace fathom::validation {

std::vector<Peer> peers_of(const std::string& renderer) {
  std::vector<std::string> variants;
  if (renderer == "vtk") {
    variants = {"own", "unorm16", "unorm24", "unorm32", "float32", "own 8 samples"};
  } else if (renderer == "opengl") {
    variants = {"unorm16",          "unorm24",           "unorm32",          "float32",
                "float32 reversed", "unorm24 offset 16", "unorm24 4 samples"};
  } else if (renderer == "embree") {
    variants = {"default", "robust"};
  } else if (renderer == "blender") {
    variants = {"cycles"};
  } else {
    throw UsageError("--against: '" + renderer + "' is none of vtk, opengl, embree and blender");
  }
  std::vector<Peer> peers;
  peers.reserve(variants.size());
  for (const std::string& variant : variants) peers.push_back({renderer, variant});
  return peers;
}

DrawnMap draw(const Peer& peer, const ValidationScene& scene) {
  if (peer.renderer == "blender") return draw_blender(world_mesh(scene.scene), scene.camera);
  return draw_built_in(peer, scene);
}

Drawing draw_in_child(const Peer& peer, const std::function<ValidationScene()>& make, int seconds) {
  // What the scene is to blame for is told apart from what the renderer is.
  try {
    const std::string bytes = bench::run_in_child(
        [&] {
          const ValidationScene scene = make();
          try {
            return "d" + to_bytes(draw(peer, scene));
          } catch (const InputError& error) {
            return "f" + std::string(error.what());
          }
        },
        seconds, peer.renderer);
    if (bytes.front() == 'f') return {std::nullopt, bytes.substr(1)};
    return {drawn_from_bytes(bytes.substr(1)), {}};
  } catch (const bench::ChildFailure& failure) {
    return {std::nullopt, failure.what()};
  }
}

}  // namespace fathom::validation
