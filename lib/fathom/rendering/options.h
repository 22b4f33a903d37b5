#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/image/channel_table.h"
#include "fathom/mesh/vertex_normals.h"

namespace fathom {

class RenderMemory;

enum class Engine { reference, fast };
/// "reference" or "fast".
std::string_view name_of(Engine engine);

/// Which triangles are left out: none, or back-facing or front-facing triangles. Facing is decided
/// exactly; the graphics pipeline has a separate option, because it decides after rounding.
enum class Cull { none, back, front };

/// How Z and distance are rounded: once from the exact number, whatever the file format.
struct DepthEncoding {
  using Type = StoredType;
  Type type = Type::binary32;
  /// For scaled_unorm16: code = round-half-even(scale·D/divisor), 0 for no surface; the quotient is
  /// exact. A depth whose code would be 0 or above 65535 is an OutputError that names the pixel.
  /// Unit     scale codes stand for `divisor` scene units.
  double scale = 1000;
  /// But one above 65535 gets the code 0, as if no surface were there; DepthMap::codes_beyond
  /// counts them.
  bool beyond_is_none = false;
  double divisor = 1;
};

/// Switches of the fast engine's optimisations: they change its time, never its map.
struct FastSwitches {
  /// Test blocks of samples before single samples.
  bool hierarchy = true;
  /// Skip blocks that are behind surfaces already drawn.
  bool early_rejection = true;
  /// The factor by which bounds on edge functions, q and areas are widened; at least 1.
  double widening = 1;
  /// Whether to look for the pixels of Rendered::doubtful.
  bool find_doubtful = false;
};

struct RenderOptions {
  Engine engine = Engine::fast;
  std::vector<Channel> channels{Channel::Z};
  Cull cull = Cull::none;
  DepthEncoding depth_encoding;
  /// Of channel Ns.
  NormalSource normals = NormalSource::file;
  FastSwitches fast;
  /// Threads to use; 0: all.
  int threads = 0;
};

/// Environment of a render. The map does not depend on it.
struct RenderContext {
  /// If set, returns the memory for a channel of the map, by its name: width × height values of its
  /// type, which outlive the map and are all written. nullptr: the map allocates its own memory.
  std::function<void*(const std::string& channel)> memory;
  /// If set, the fast engine keeps memory that it works with there, from one frame to the next; one
  /// frame at a time.
  RenderMemory* kept = nullptr;
  /// Called now and then, from any thread but never from two at once, with the fraction done, in
  /// [0, 1].
  std::function<void(double)> progress;
};

/// Refuses meaningless options: no channel; for scaled_unorm16 a scale, a divisor or their quotient
/// that is not a positive number; a widening that is not a number of at least 1; a negative number
/// of threads.
/// Fails    UsageError.
void require_meaningful(const RenderOptions& options);

// The names of the values of RenderOptions: the only place that states them for the command line,
// Python, messages and the texts of a map. Lists are in the order of messages; value_named()
// (unknown_name.h) finds a value by its name.

inline constexpr std::array all_engines{Engine::fast, Engine::reference};

inline constexpr std::array all_culls{Cull::back, Cull::front, Cull::none};
/// "back", "front" or "none".
std::string_view name_of(Cull cull);

inline constexpr std::array all_normal_sources{NormalSource::file, NormalSource::vertex,
                                               NormalSource::place};

inline constexpr std::array all_stored_types{StoredType::binary32, StoredType::binary64,
                                             StoredType::scaled_unorm16};
/// The type of an array in NumPy: "float32", "float64" or "uint16".
std::string_view name_of(StoredType type);

}  // namespace fathom
