#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/depth_format/depth_format.h"

/// The settings of VTK and OpenGL: the driver, and a variant of each, by name.
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

// What the names of variants are made of: words with one blank between them.

/// The words of `name`; two blanks in a row have an empty word between them. Never empty.
std::vector<std::string_view> words_of(std::string_view name);

/// The number that a whole word is, in decimal digits; nothing below `least` or beyond int.
std::optional<int> count_named(std::string_view word, int least);

/// The storage types that a depth attachment of OpenGL may have.
inline constexpr Storage attachment_storages[] = {Storage::unorm16, Storage::unorm24,
                                                  Storage::unorm32, Storage::float32};
std::optional<Storage> attachment_named(std::string_view word);

/// How OpenGL draws: the depth attachment and how it is used.
struct OpenGlVariant {
  /// One of attachment_storages; the model records the storage that the driver grants.
  Storage storage = Storage::unorm24;
  /// glClipControl(…, GL_ZERO_TO_ONE), near and far exchanged, the greater depth wins.
  bool reversed = false;
  /// glPolygonOffset(0, units); 0: none.
  int offset_units = 0;
  /// Samples per pixel; 1: no multisampling. Reads back the sample to which glBlitFramebuffer
  /// resolves.
  int samples = 1;
  Driver driver = Driver::usual;

  friend bool operator==(const OpenGlVariant&, const OpenGlVariant&) = default;
};

/// Without the driver: "unorm24", "float32 reversed", "unorm24 offset 16", "unorm24 4 samples".
std::string name_of(const OpenGlVariant& variant);

/// Parses `name`: a storage and, each at most once, `reversed`, `offset` with a positive number of
/// units, a number of samples of at least 2. Nothing if a word is left over.
std::optional<OpenGlVariant> opengl_variant_named(std::string_view name);

/// In a sentence: what names there are.
std::string opengl_variant_names();

/// How VTK draws: the depth attachment and the encoding of its depths.
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
  /// Samples per pixel requested from VTK; 0: no multisampling. Interpolated depths only.
  int samples = 0;
  /// Peeled meshes have VTK's own attachment, interpolated depths and no multisampling.
  Mesh mesh = Mesh::opaque;
  Driver driver = Driver::usual;

  friend bool operator==(const VtkVariant&, const VtkVariant&) = default;
};

/// Without the driver: "own", "unorm24", "float32 reversed by shader", "own 8 samples", "own
/// peeled".
std::string name_of(const VtkVariant& variant);

/// Parses `name`: `own` or a storage, then nothing, an encoding or a positive number of samples; or
/// `own` and the way of peeling. Nothing if a word is left over.
std::optional<VtkVariant> vtk_variant_named(std::string_view name);

/// In a sentence: what names there are.
std::string vtk_variant_names();

}  // namespace fathom::validation
