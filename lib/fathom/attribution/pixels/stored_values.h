#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "fathom/attribution/fragment.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"
#include "fathom/numeric/interval.h"

namespace fathom::attribution {

/// A window depth minus its unrounded expectation, in steps of the storage, and the part of it that
/// may be roundings shared by all triangles.
struct BiasSteps {
  double off = 0, shared = 0;
};

/// The values by which fragments and the other map are compared: window depths (smaller is nearer)
/// if the other map's are known, otherwise depths in scene units. Pixels are numbered row by row
/// from the top left.
class StoredValues {
 public:
  StoredValues() = default;
  virtual ~StoredValues() = default;
  StoredValues(const StoredValues&) = delete;
  StoredValues& operator=(const StoredValues&) = delete;

  /// All values that may be stored for a fragment, and the value without any rounding.
  [[nodiscard]] virtual Interval interval(const Fragment& f) const = 0;
  [[nodiscard]] virtual double exact(const Fragment& f) const = 0;
  /// Converts a bound on fragments' values to a bound on compared values.
  [[nodiscard]] virtual double limit(double value) const = 0;
  /// Value of the other map.
  [[nodiscard]] virtual double other(std::size_t pixel) const = 0;
  /// All depths that may be read for a fragment.
  [[nodiscard]] virtual Interval as_depths(const Fragment& f) const = 0;

  /// Whether the other map shows the background; and whether a surface may look like background, as
  /// surfaces at the far plane do if window depths are known.
  [[nodiscard]] virtual bool is_background(std::size_t pixel) const = 0;
  [[nodiscard]] virtual bool surfaces_may_look_like_background() const = 0;

  /// Whether the other map's value is the exact depth's value rounded once, or next to it.
  [[nodiscard]] virtual bool is_nearest(std::size_t pixel, double depth) const = 0;
  [[nodiscard]] virtual bool is_neighbour(std::size_t pixel, double depth) const = 0;
  /// Width of a fragment's interval in steps of the storage about `depth`.
  [[nodiscard]] virtual double steps(const Fragment& f, double depth) const = 0;
  /// The bias of the other map's value; nullopt for a model without window depths.
  [[nodiscard]] virtual std::optional<BiasSteps> bias_steps(std::size_t pixel,
                                                            const Fragment& f) const = 0;
};

/// Truth and map outlive the result.
std::unique_ptr<StoredValues> stored_values(const Truth& truth, const OtherMap& other,
                                            const RendererModel& model);
std::unique_ptr<StoredValues> raster_values(const Truth& truth, const OtherMap& other,
                                            const RasterModel& model);
std::unique_ptr<StoredValues> ray_values(const OtherMap& other);
/// For recorded depths: `made` is the renderer's own storage.
std::unique_ptr<StoredValues> recorded_values(std::unique_ptr<StoredValues> made,
                                              const OtherMap& other, const RecordedDepth& recorded);

/// The possible values of depths after decoding and rounding to binary32.
Interval rounded_to_binary32(const Interval& depths);

/// The distance of neighbouring binary32 numbers about x.
double binary32_spacing(double x);

/// A step of the model's storage at a window depth, as a window depth: one code, but at least the
/// resolution of binary32 there and the error of a shader's log2.
double storage_step(const RasterModel& model, double window);

}  // namespace fathom::attribution
