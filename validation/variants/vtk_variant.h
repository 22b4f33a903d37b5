#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fathom/depth_format/depth_format.h"

namespace fathom::validation {

/// How VTK draws: the depth attachment and what is written to it.
struct VtkVariant {
  enum class Encoding {
    interpolated,        ///< VTK's own
    reversed,            ///< glClipControl and exchanged clip planes, beneath VTK
    reversed_by_shader,  ///< VTK's fragment shader writes it
    logarithmic          ///< VTK's fragment shader writes it
  };

  /// One of attachment_storages; VTK's own choice where not given.
  std::optional<Storage> attachment;
  Encoding encoding = Encoding::interpolated;
  /// Samples per pixel that VTK is asked for; 0: no multisampling. Interpolated depths only.
  int samples = 0;

  friend bool operator==(const VtkVariant&, const VtkVariant&) = default;
};

/// "own", "unorm24", "float32 reversed by shader", "own 8 samples".
std::string name_of(const VtkVariant& variant);

/// What `name` says: `own` or a storage, then nothing, one encoding or a positive number of
/// samples. Nothing where any word is left over.
std::optional<VtkVariant> vtk_variant_named(std::string_view name);

/// In a sentence: what names there are.
std::string vtk_variant_names();

}  // namespace fathom::validation
