#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "validation/variants/variants.h"

/// Renderers and the variants in which each of them draws. Names are parsed only here; all other
/// code uses the types.
namespace fathom::validation {

/// How Embree traces.
struct EmbreeVariant {
  /// RTC_SCENE_FLAG_ROBUST: no ray slips through between two triangles.
  bool robust = false;

  friend bool operator==(const EmbreeVariant&, const EmbreeVariant&) = default;
};

/// Blender renders with Cycles.
struct BlenderVariant {
  friend bool operator==(const BlenderVariant&, const BlenderVariant&) = default;
};

/// A renderer in one of its variants.
using Peer = std::variant<VtkVariant, OpenGlVariant, EmbreeVariant, BlenderVariant>;

enum class Renderer { vtk, opengl, embree, blender };

/// A renderer, with the driver where it draws with OpenGL.
struct DrivenRenderer {
  DrivenRenderer(Renderer which, Driver with = Driver::usual) : renderer(which), driver(with) {}

  Renderer renderer;
  Driver driver;

  friend bool operator==(const DrivenRenderer&, const DrivenRenderer&) = default;
};

/// "vtk", "opengl", "embree", "blender"; "opengl@softpipe".
std::string name_of(const DrivenRenderer& renderer);
/// Fails    UsageError for an unknown renderer or driver, naming the existing ones, or for a driver
///          of a renderer that draws without OpenGL.
DrivenRenderer renderer_named(std::string_view name);

DrivenRenderer renderer_of(const Peer& peer);
/// Nothing for a renderer that draws without OpenGL.
void set_driver(Peer& peer, Driver driver);
/// The variant without its driver: "float32 reversed", "robust", "cycles".
std::string variant_name(const Peer& peer);

/// The named model (attribution/model/named_models.h) of its maps, if it has one.
std::optional<std::string> matching_model(const Peer& peer);

/// Fails    UsageError where `variant` is not one of the renderer's, saying which there are.
Peer peer_named(const DrivenRenderer& renderer, std::string_view variant);

/// The `peers` whose variant is among `variants`, in the order of `peers`.
/// Fails    UsageError for a variant that no peer has, naming the existing variants.
std::vector<Peer> with_variants(std::span<const Peer> peers, std::span<const std::string> variants);

}  // namespace fathom::validation
