#pragma once

#include <array>
#include <vector>

#include "apps/shell/command.h"
#include "fathom/camera/camera_making.h"

namespace fathom::app {

/// `--view --up`: where a camera stands as seen from what it looks at.
std::array<Option, 2> add_view_options(Command& command, View& view);

/// `--up`: a word for an axis of the world, or a vector.
Option add_up_option(Command& command, Vector3& up);

/// `--size --fov --focal --orthographic --near --far`: the lens of a camera that is made;
/// `--fov` is the vertical angle.
std::vector<Option> add_lens_options(Command& command, Lens& lens);

}  // namespace fathom::app
