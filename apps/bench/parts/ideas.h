#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/bench/parts/edge_setup.h"
#include "apps/bench/parts/exact_picture.h"
#include "fathom/pipeline/options.h"
#include "fathom/rendering/options.h"
#include "fathom/rendering/rendered.h"
#include "validation/scenes/scenes.h"

namespace fathom::bench {

/// A count of events while drawing, which explains the time of a variant.
struct Count {
  std::string name;
  double value = 0;
};
using Counts = std::vector<Count>;

/// One way of drawing a scene.
struct Variant {
  std::string name;
  /// The variant with which its time is compared, as a place in the idea. A plain variant is
  /// compared with itself.
  std::size_t plain = 0;
  /// Not timed; comes before draw().
  std::function<void()> prepare = [] {};
  std::function<void()> draw;
  /// The last picture, its counts, and the expected picture.
  std::function<Picture()> picture;
  std::function<Counts()> counts = [] { return Counts(); };
  std::shared_ptr<const Picture> expected;
  /// Whether different pixels are counted instead of refused, for arithmetic that is not exact.
  bool may_differ = false;
};

/// One idea that makes drawing faster, switched on and off.
struct Idea {
  /// "lanes of binary32"
  std::string name;
  std::vector<Variant> variants;
  /// A sentence that a reader of the table needs; may be empty.
  std::string note;
};

struct VariantTimes {
  std::string name, plain;
  /// In increasing order; not empty.
  std::vector<double> milliseconds;
  /// How many times as fast as the plain variant, by the least time of each: other processes on the
  /// machine can only add to a time, and add more to a long one.
  double speed_up = 1;
  Counts counts;

  [[nodiscard]] double median_ms() const;
};

struct IdeaTimes {
  std::string name, note;
  std::vector<VariantTimes> variants;
};

/// A variant drew another picture than expected, so its time would mean nothing.
class WrongPicture : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Draws with every variant once, untimed, and compares the pictures. Then times all variants in
/// turn, `repeat` times, so that other load on the machine affects all of them. A time is the least
/// time of the draws within 30 milliseconds, or the time of a single longer draw. Starts no round
/// after 20 seconds.
/// Fails    WrongPicture: the variant, and how many pixels differ.
IdeaTimes time_idea(const Idea& idea, int repeat);

// The ideas. Variants keep what they draw; the scene must outlive them.

/// A scene to draw, as it is and as it reaches scan conversion.
struct PartsScene {
  explicit PartsScene(BenchScene its_scene)
      : bench(std::move(its_scene)), window(snapped(bench)), setups(set_up_edges(window)) {}
  BenchScene bench;
  SnappedScene window;
  std::vector<EdgeSetup> setups;
};

/// 1, 2, 4, 8 and 16 pixels of a row at once: in binary32, in binary64, and the fast engine with
/// each width of vectors that the processor has.
std::vector<Idea> lanes(const PartsScene& scene);
/// Blocks of pixels before pixels: in the textbook's loop, in the pipeline, in the fast engine.
std::vector<Idea> blocks(const PartsScene& scene);
/// The depth test before shading, and the fast engine's rejection of blocks, by the order in which
/// triangles are drawn.
std::vector<Idea> early_rejection(const PartsScene& scene);
/// Tiles of several sizes, each with its own z-buffer, compared with the whole image.
std::vector<Idea> tiles(const PartsScene& scene);
/// One thread and more.
std::vector<Idea> threads(const PartsScene& scene, const std::vector<int>& counts);
/// Back faces left out. Empty if that changes the picture, as it does if a mesh is not closed.
std::vector<Idea> culling(const PartsScene& scene);

/// "lanes", "blocks", "early-rejection", "tiles", "threads", "culling".
const std::vector<std::string>& idea_names();
/// The ideas of a name. Fails    UsageError if there is none.
std::vector<Idea> ideas_named(const std::string& name, const PartsScene& scene,
                              const std::vector<int>& thread_counts);

// Variants that draw with the pipeline and the fast engine; the picture of the latter is channel
// Z.

/// The options of the pipeline's variants: without shading, so that no picture is made.
pipeline::PipelineOptions plain_pipeline();
/// The pipeline by `options`; counts: what it counted. The picture is what the depth buffer holds
/// in the end and, with shading, the colours. (Surfaces that are equally near to the depth buffer
/// need not be so to channel Z, and then their order shows in it.)
Variant pipeline_variant(std::string name, const BenchScene& bench,
                         const pipeline::PipelineOptions& options,
                         std::function<Counts(const pipeline::PipelineStatistics&)> counts);
/// The fast engine, channel Z.
Variant fast_variant(std::string name, const BenchScene& bench, const RenderOptions& options,
                     std::function<Counts(const RenderStatistics&)> counts);

/// Draws once; what a variant draws is what those compared with it have to draw.
std::shared_ptr<const Picture> picture_of(const Variant& variant);

/// Appends a plain variant and those that are compared with it, all of which have to draw the same.
void add_group(std::vector<Variant>& variants, std::vector<Variant> group);

}  // namespace fathom::bench
