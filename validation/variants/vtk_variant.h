#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fathom/depth_format/depth_format.h"
#include "validation/variants/driver.h"

namespace fathom::validation {

/// How VTK draws: the depth attachment and what is written to it.
struct VtkVariant {
  enum class Encoding {
    interpolated,        ///< VTK's own
    reversed,            ///< glClipControl and exchanged clip planes, beneath VTK
    reversed_by_shader,  ///< VTK's fragment shader writes it
    logarithmic          ///< VTK's fragment shader writes it
  };

  enum class Mesh {
    opaque,
    peeled,        ///< translucent, drawn by depth peeling: the depths of the nearest layer
    behind_peeled  ///< opaque, behind a translucent pane that is drawn by depth peeling
  };

  /// One of attachment_storages; VTK's own choice where not given.
  std::optional<Storage> attachment;
  Encoding encoding = Encoding::interpolated;
  /// Samples per pixel that VTK is asked for; 0: no multisampling. Interpolated depths only.
  int samples = 0;
  /// Peeled meshes have VTK's own attachment, interpolated depths and no multisampling.
  Mesh mesh = Mesh::opaque;
  Driver driver = Driver::usual;

  friend bool operator==(const VtkVariant&, const VtkVariant&) = default;
};

/// Without the driver: "own", "unorm24", "float32 reversed by shader", "own 8 samples", "own
/// peeled".
std::string name_of(const VtkVariant& variant);

/// What `name` says: `own` or a storage, then nothing, one encoding or a positive number of
/// samples; or `own` and how the mesh is peeled. Nothing where any word is left over.
std::optional<VtkVariant> vtk_variant_named(std::string_view name);

/// In a sentence: what names there are.
std::string vtk_variant_names();

}  // namespace fathom::validation
