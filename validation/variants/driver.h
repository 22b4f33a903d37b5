#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fathom::validation {

/// The OpenGL driver that a drawing is made with.
enum class Driver {
  usual,     ///< what OpenGL gives this machine
  llvmpipe,  ///< Mesa's rasterizer that compiles shaders
  softpipe   ///< Mesa's plain one, in C
};

/// "llvmpipe", "softpipe"; "" for the usual one.
std::string name_of(Driver driver);
/// Nothing where no driver has this name; the usual one has none.
std::optional<Driver> driver_named(std::string_view name);
/// In a sentence: what names there are.
std::string driver_names();

}  // namespace fathom::validation
