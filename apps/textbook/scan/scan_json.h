#pragma once

#include "apps/textbook/scan/scan_algorithms.h"
#include "fathom/clipping/points.h"
#include "fathom/pipeline/scan/area_fill.h"

/// Reads the cases of `fathom scan`, and writes the pixels of the answers.
/// Fails    InputError, naming the place.
namespace fathom::app::scan {

/// "width" and "height", both or neither: without them the window contains every pixel.
pipeline::PixelWindow window_of(const Json& object);

/// Refuses coordinates beyond ±2³¹; `where` names them.
double checked_coordinate(double x, const std::string& where);

/// A last corner of a ring that repeats the first corner and so closes the ring. Corners are
/// numbered as they are written, ring after ring.
struct ClosingCorner {
  std::size_t corner, first;
};

/// The rings of "polygon", each with at least three corners, without the corners that close them.
/// Closing corners are appended to `closing`.
clipping::Rings<double> polygon_of(const Json& object,
                                   std::vector<ClosingCorner>* closing = nullptr);

/// The corners of "triangle", snapped if --subpixel-bits is given.
clipping::Ring<double> triangle_of(const Json& object, const Form& form);

/// The values at corners: "attributes" and "w".
struct CarriedAlong {
  std::vector<std::vector<double>> attributes;  ///< a list for each corner
  std::vector<double> w;                        ///< one for each corner, or none

  [[nodiscard]] bool any() const { return !attributes.empty() && !attributes[0].empty(); }
};
/// `corners` does not count closing corners. These have entries too, equal to the entries of the
/// first corner of their ring, which are dropped.
CarriedAlong carried_along(const Json& object, std::size_t corners,
                           const std::vector<ClosingCorner>& closing = {});

/// The attributes of a corner as they go through interpolation: a, or with w: a/w … and 1/w.
template <class Number>
std::vector<Number> prepared(const CarriedAlong& carried, std::size_t corner) {
  std::vector<Number> result;
  for (const double a : carried.attributes[corner])
    result.push_back(pipeline::number_from<Number>(a));
  if (carried.w.empty() || !carried.any()) return result;
  const Number w = pipeline::number_from<Number>(carried.w[corner]);
  for (Number& a : result) a = a / w;
  result.push_back(Number(Number(1) / w));
  return result;
}

/// Back from a/w … and 1/w to a.
template <class Number>
std::vector<Number> recovered(const CarriedAlong& carried, std::vector<Number> values) {
  if (carried.w.empty() || values.empty()) return values;
  const Number inverse_w = values.back();
  values.pop_back();
  if (inverse_w == Number(0)) throw InputError("1/w is 0 at a pixel: the w have different signs");
  for (Number& a : values) a = a / inverse_w;
  return values;
}

/// The pixels of an answer, and the values at them, if any.
class PixelList {
 public:
  explicit PixelList(bool runs) : runs_(runs) {}

  void add(const pipeline::Pixel& pixel);
  void add(const pipeline::Span& span);
  /// Counts `entries` more entries that the answer is about to get, of values or the trace.
  /// Fails    InputError if there are too many, because an answer stays in memory.
  void make_room(std::int64_t entries);
  void add_values(Json values) { values_.push_back(std::move(values)); }
  /// {"pixels"} or {"runs"}, and {"values"}.
  [[nodiscard]] Json json(bool with_values) const;

 private:
  bool runs_;
  std::int64_t total_ = 0;
  std::vector<pipeline::Span> spans_;
  Json values_ = Json::array();
};

}  // namespace fathom::app::scan
