#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "validation/drawn_map.h"
#include "validation/scenes/validation_scenes.h"
#include "validation/variants/peer.h"
#include "validation/vtk/drawn_by_vtk.h"

namespace fathom::validation {

/// The variants of a renderer in which each scene is validated. Numbers of samples are those that
/// OpenGL's driver offers, which is asked in a process of its own that is ended after `seconds`.
/// Needs    a process that has started no threads.
std::vector<Peer> peers_of(const DrivenRenderer& renderer, int seconds);

/// A map, or why there is none, in one line.
struct Drawing {
  std::optional<DrawnMap> drawn;
  std::string failure;
};

/// Makes the scene and has it drawn in a process of its own, which is ended after `seconds`.
/// Needs    a process that has started no threads.
/// `make` fails as in this process.
Drawing draw_in_child(const Peer& peer, const std::function<ValidationScene()>& make, int seconds);

/// The same here and now. Fails with InputError, in one line, where the renderer is not there.
DrawnMap draw(const Peer& peer, const ValidationScene& scene);

/// Makes the scene and has VTK draw it in colour in a process of its own, which is ended after
/// `seconds`.
/// Needs    a process that has started no threads.
/// Fails    as `make` does; InputError, in one line, where VTK or OpenGL is not there;
///          ChildFailure.
GreyPicture draw_colours_in_child(const std::function<LitScene()>& make, VtkShading shading,
                                  int seconds);

}  // namespace fathom::validation
