#pragma once

#include "apps/textbook/scan/scan_algorithms.h"
#include "fathom/clipping/points.h"
#include "fathom/pipeline/scan/area_fill.h"

/// Reading the cases of `fathom scan`, and writing the pixels of the answers.
/// Fails    InputError in words that name the place.
namespace fathom::app::scan {

/// "width" and "height", both or none: without them every pixel is asked for.
pipeline::PixelWindow window_of(const Json& object);

/// Refuses coordinates beyond ±2³¹; `where` names them.
double checked_coordinate(double x, const std::string& where);

/// The corners that close their rings: the last one of a ring where it repeats the first. Corners
/// are numbered as they are written, ring after ring.
struct ClosingCorner {
  std::size_t corner, first;
};

/// The rings of "polygon", each of three corners or more, without the corners that close them;
/// these are appended to `closing`.
clipping::Rings<double> polygon_of(const Json& object,
                                   std::vector<ClosingCorner>* closing = nullptr);

/// The corners of "triangle", snapped where --subpixel-bits says so.
clipping::Ring<double> triangle_of(const Json& object, const Form& form);

/// What is carried along at corners: "attributes" and "w".
struct CarriedAlong {
  std::vector<std::vector<double>> attributes;  ///< a list for each corner
  std::vector<double> w;                        ///< one for each corner, or none

  [[nodiscard]] bool any() const { return !attributes.empty() && !attributes[0].empty(); }
};
/// `corners` are without the closing ones, which have entries too: those of the first corner of the
/// ring, which are dropped.
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

/// The pixels of an answer, and the values at them where there are any.
class PixelList {
 public:
  explicit PixelList(bool runs) : runs_(runs) {}

  void add(const pipeline::Pixel& pixel);
  void add(const pipeline::Span& span);
  /// Counts `entries` more things, of the values or the trace, that the answer is about to hold.
  /// Fails    InputError where it holds too many: an answer stays in memory.
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
