#include "validation/peers/drawing.h"

#include <algorithm>

#include "fathom/failures/errors.h"
#include "validation/blender/blender_renderer.h"
#include "validation/child/in_child.h"
#include "validation/peers/built_in_peers.h"
#include "validation/peers/drawing_fields.h"

namespace fathom::validation {

using attribution::world_mesh;

namespace {

/// Empty without OpenGL; variants without samples report the reason.
std::vector<int> offered_samples(Driver driver, int seconds) {
  try {
    return in_child([&] { return built_in_samples(driver); },
                    {.name = "opengl", .seconds = seconds});
  } catch (const InputError&) {
    return {};
  }
}

std::vector<Peer> vtk_peers(Driver driver, int seconds) {
  using Encoding = VtkVariant::Encoding;
  std::vector<Peer> peers{
      VtkVariant{},
      VtkVariant{.attachment = Storage::unorm16},
      VtkVariant{.attachment = Storage::unorm24},
      VtkVariant{.attachment = Storage::unorm32},
      VtkVariant{.attachment = Storage::float32},
      VtkVariant{.attachment = Storage::float32, .encoding = Encoding::reversed},
      VtkVariant{.attachment = Storage::float32, .encoding = Encoding::reversed_by_shader},
      VtkVariant{.attachment = Storage::unorm24, .encoding = Encoding::logarithmic},
      VtkVariant{.attachment = Storage::float32, .encoding = Encoding::logarithmic}};
  std::vector<int> counts = offered_samples(driver, seconds);
  const int usual = 8;  // VTK's default; the driver may grant fewer
  if (std::find(counts.begin(), counts.end(), usual) == counts.end()) counts.push_back(usual);
  for (const int count : counts) peers.emplace_back(VtkVariant{.samples = count});
  peers.emplace_back(VtkVariant{.mesh = VtkVariant::Mesh::peeled});
  peers.emplace_back(VtkVariant{.mesh = VtkVariant::Mesh::behind_peeled});
  return peers;
}

std::vector<Peer> opengl_peers(Driver driver, int seconds) {
  std::vector<Peer> peers{OpenGlVariant{.storage = Storage::unorm16},
                          OpenGlVariant{.storage = Storage::unorm24},
                          OpenGlVariant{.storage = Storage::unorm32},
                          OpenGlVariant{.storage = Storage::float32},
                          OpenGlVariant{.storage = Storage::float32, .reversed = true},
                          OpenGlVariant{.storage = Storage::unorm24, .offset_units = 16}};
  for (const int count : offered_samples(driver, seconds)) {
    peers.emplace_back(OpenGlVariant{.storage = Storage::unorm24, .samples = count});
  }
  return peers;
}

DrawnMap draw_variant(const BlenderVariant& /*variant*/, const ValidationScene& scene) {
  return draw_blender(world_mesh(scene.scene), scene.camera);
}

template <class BuiltIn>
DrawnMap draw_variant(const BuiltIn& variant, const ValidationScene& scene) {
  return draw_built_in(variant, scene);
}

}  // namespace

std::vector<Peer> peers_of(const DrivenRenderer& driven, int seconds) {
  const auto with_driver = [&](std::vector<Peer> peers) {
    for (Peer& peer : peers) set_driver(peer, driven.driver);
    return peers;
  };
  switch (driven.renderer) {
    case Renderer::vtk:
      return with_driver(vtk_peers(driven.driver, seconds));
    case Renderer::opengl:
      return with_driver(opengl_peers(driven.driver, seconds));
    case Renderer::embree:
      return {EmbreeVariant{}, EmbreeVariant{.robust = true}};
    case Renderer::blender:
      break;
  }
  return {BlenderVariant{}};
}

DrawnMap draw(const Peer& peer, const ValidationScene& scene) {
  return std::visit([&](const auto& variant) { return draw_variant(variant, scene); }, peer);
}

Drawing draw_in_child(const Peer& peer, const std::function<ValidationScene()>& make, int seconds) {
  // Keeps faults of the scene apart from faults of the renderer.
  const auto drawing = [&]() -> Drawing {
    const ValidationScene scene = make();
    try {
      return {draw(peer, scene), ""};
    } catch (const InputError& error) {
      return {std::nullopt, error.what()};
    }
  };
  try {
    return in_child(drawing, {.name = name_of(renderer_of(peer)), .seconds = seconds});
  } catch (const ChildFailure& failure) {
    return {std::nullopt, failure.what()};
  }
}

GreyPicture draw_colours_in_child(const std::function<LitScene()>& make, VtkShading shading,
                                  int seconds) {
  return in_child([&] { return draw_built_in_colours(make(), shading); },
                  {.name = "vtk", .seconds = seconds});
}

}  // namespace fathom::validation
