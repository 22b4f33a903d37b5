#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/image/channel_table.h"
#include "fathom/mesh/normal_source.h"
#include "fathom/numeric/certified.h"

namespace fathom {

class RenderMemory;

enum class Engine { reference, fast };
/// "reference" or "fast".
std::string_view name_of(Engine engine);

/// Which triangles are left out: none, the back-facing or the front-facing ones. Facing is decided
/// exactly; the pipeline of the textbooks has a choice of its own, since it decides after rounding.
enum class Cull { none, back, front };

/// How Z and distance are rounded: once from the exact number, whatever the file format.
struct DepthEncoding {
  using Type = StoredType;
  Type type = Type::binary32;
  /// For scaled_unorm16: code = round-half-even(scale·D/divisor), 0 for no surface; the quotient is exact.
  /// A depth whose code would be 0 or above 65535 is an OutputError that names the pixel.
  /// Unit     scale codes stand for `divisor` scene units.
  double scale = 1000;
  /// But one above 65535 gets the code 0, as if no surface were there; DepthMap::codes_beyond counts
  /// them.
  bool beyond_is_none = false;
  double divisor = 1;
};

/// How decisions were made. The fast engine asks fewer questions: triangles that reach behind the
/// camera and miss the image are not counted as degenerate or culled, and samples are counted as
/// covered only where the triangle is not behind one that was drawn before.
struct RenderStatistics {
  std::uint64_t triangles = 0;
  std::uint64_t degenerate_triangles = 0;  // Δ = 0, seen edge on
  std::uint64_t culled_triangles = 0;
  std::uint64_t samples_tested = 0;
  std::uint64_t samples_covered = 0;
  std::uint64_t pixels_with_surface = 0;
  TierCounts facing, edges, visibility, range;
  /// Signs asked for by channel A.
  TierCounts coverage;

  // Only in the fast engine:
  /// Pixels whose coverage is not evidently 0 or 1: settled by a bound, and by exact numbers.
  TierCounts coverage_rounding;
  /// Values rounded from an interval, and values written from exact numbers.
  TierCounts rounding;
  /// Those of rounding.interval that binary64 did not settle, but double-words did.
  std::uint64_t double_word_roundings = 0;
  /// Areas that needed the ends of edges from exact numbers; coverage_rounding counts them, too.
  std::uint64_t areas_with_exact_ends = 0;
  /// Samples that binary32 did not settle: settled by binary64, or counted as exact.
  std::uint64_t samples_in_binary64 = 0;
  /// How often a triangle was set up from exact numbers or double-words: once for each tile that it
  /// meets, and once to find them.
  std::uint64_t exact_setups = 0;
  /// Those of visibility.exact that were settled because both triangles lie in one plane.
  std::uint64_t same_plane = 0;
  /// Those of edges.exact, visibility.exact and range.exact that were settled by double-words.
  std::uint64_t double_words = 0;
  /// How often, once for each tile, a triangle was set up with corners exactly on the grid on which
  /// edge functions have no error.
  std::uint64_t grid_setups = 0;
};

/// Adds the counts of a part of the work; not `triangles`, which is known beforehand.
void add(RenderStatistics& sum, const RenderStatistics& part);

/// What the fast engine may leave out or do more carefully: this changes its time, never its map.
struct FastSwitches {
  /// Test blocks of samples before single samples.
  bool hierarchy = true;
  /// Skip blocks that are behind what is already drawn.
  bool early_rejection = true;
  /// The factor by which bounds on edge functions, q and areas are widened; at least 1.
  double widening = 1;
  /// If set, gets the pixels (row · width + column) at which such a bound did not settle a decision
  /// about an edge, the range, visibility, or the rounding of Z or of A; some of them twice.
  std::vector<std::uint64_t>* doubtful = nullptr;
};

struct RenderOptions {
  Engine engine = Engine::fast;
  std::vector<Channel> channels{Channel::Z};
  Cull cull = Cull::none;
  DepthEncoding depth_encoding;
  /// Of channel Ns.
  NormalSource normals = NormalSource::file;
  FastSwitches fast;
  /// If set, asked for the memory of each channel of the map, by its name: width × height values of
  /// its type, which outlive the map, and of which all are written. nullptr: memory of its own.
  std::function<void*(const std::string& channel)> memory;
  /// If set, the fast engine keeps memory that it works with there, from one frame to the next; one
  /// frame at a time.
  RenderMemory* kept = nullptr;
  /// Threads to use; 0: all.
  int threads = 0;
  /// Called now and then, from any thread but never from two at once, with the fraction done, in
  /// [0, 1].
  std::function<void(double)> progress;
  /// If set, filled in.
  RenderStatistics* statistics = nullptr;
};

/// Refuses options that mean nothing: no channel, a scale, a divisor or their quotient that is not a
/// positive number for scaled_unorm16, a widening that is not a number from 1 on, a negative number of threads.
/// Fails    UsageError.
void require_meaningful(const RenderOptions& options);

}  // namespace fathom
