#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fathom/depth_format/depth_format.h"
#include "validation/variants/driver.h"

namespace fathom::validation {

/// How OpenGL draws: the depth attachment and how it is used.
struct OpenGlVariant {
  /// One of attachment_storages; what the driver grants is recorded in the model.
  Storage storage = Storage::unorm24;
  /// glClipControl(…, GL_ZERO_TO_ONE), near and far exchanged, the greater depth wins.
  bool reversed = false;
  /// glPolygonOffset(0, units); 0: none.
  int offset_units = 0;
  /// Samples per pixel; 1: no multisampling. What is read back is what glBlitFramebuffer resolves
  /// to.
  int samples = 1;
  Driver driver = Driver::usual;

  friend bool operator==(const OpenGlVariant&, const OpenGlVariant&) = default;
};

/// Without the driver: "unorm24", "float32 reversed", "unorm24 offset 16", "unorm24 4 samples".
std::string name_of(const OpenGlVariant& variant);

/// What `name` says: a storage and, each at most once, `reversed`, `offset` with a positive number
/// of units, a number of samples from 2. Nothing where any word is left over.
std::optional<OpenGlVariant> opengl_variant_named(std::string_view name);

/// In a sentence: what names there are.
std::string opengl_variant_names();

}  // namespace fathom::validation
