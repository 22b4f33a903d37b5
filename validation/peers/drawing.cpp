#include "validation/peers/drawing.h"

#include <algorithm>
#include <sstream>

#include "fathom/numeric/errors.h"
#include "validation/bench/in_child.h"
#include "validation/blender/blender_renderer.h"
#include "validation/peers/built_in_peers.h"

namespace fathom::validation {

namespace {

/// None where there is no OpenGL: the variants without samples say so.
std::vector<int> offered_samples(int seconds) {
  std::vector<int> counts;
  try {
    std::istringstream answer(bench::run_in_child(
        [] {
          std::string text;
          for (const int count : built_in_samples()) text += std::to_string(count) + " ";
          return text;
        },
        seconds, "opengl"));
    for (int count = 0; answer >> count;) counts.push_back(count);
  } catch (const InputError&) {
    counts.clear();
  }
  return counts;
}

void add_samples(std::vector<std::string>& variants, const std::string& storage,
                 const std::vector<int>& counts) {
  for (const int count : counts) {
    variants.push_back(storage + " " + std::to_string(count) + " samples");
  }
}

}  // namespace

std::vector<Peer> peers_of(const std::string& renderer, int seconds) {
  std::vector<std::string> variants;
  if (renderer == "vtk") {
    variants = {"own",
                "unorm16",
                "unorm24",
                "unorm32",
                "float32",
                "float32 reversed",
                "float32 reversed by shader",
                "unorm24 logarithmic",
                "float32 logarithmic"};
    std::vector<int> counts = offered_samples(seconds);
    const int usual = 8;  // VTK's default, whatever is granted of it
    if (std::find(counts.begin(), counts.end(), usual) == counts.end()) counts.push_back(usual);
    add_samples(variants, "own", counts);
  } else if (renderer == "opengl") {
    variants = {"unorm16", "unorm24",          "unorm32",
                "float32", "float32 reversed", "unorm24 offset 16"};
    add_samples(variants, "unorm24", offered_samples(seconds));
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
