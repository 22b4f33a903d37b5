#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

/// Pictures of steps as SVG, readable on light and on dark pages. They are drawn from the JSON of
/// the answer, so a picture has the same numbers as --trace.
namespace fathom::app::drawing {

using Json = nlohmann::ordered_json;

/// A place on the page, in CSS pixels, y down.
struct Place {
  double x = 0, y = 0;
};

struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// A number of an answer in binary64: for "p/q", the nearest one.
double number_of(const Json& number);

/// A number of an answer as a picture shows it: unchanged if it is short, else to 5 significant
/// digits.
std::string shown(const Json& number);

/// The approximate width of a text; labels reserve this width.
double width_of(std::string_view text, double size = 13);

/// A drawing of one case. The kinds are classes of the style sheet in picture.cpp: "ink", "thin",
/// "soft", "fill", "a", "b", "c", …. Later drawings cover earlier ones.
class Picture {
 public:
  void line(Place a, Place b, std::string_view kind, bool dashed = false);
  void arrow(Place a, Place b, std::string_view kind);
  void polygon(const std::vector<Place>& corners, std::string_view kind);
  void rect(const Box& box, std::string_view kind);
  void dot(Place at, std::string_view kind, double radius = 3.5);
  /// A rectangle of a colour of the scene, 0 to 1.
  void swatch(const Box& box, const Json& colour);

  /// `anchor`: start, middle or end; the text's base line goes through `at`.
  void text(Place at, std::string_view words, std::string_view kind = "text",
            std::string_view anchor = "start");
  /// A number of the answer. Its text is shown(), its attribute data-value the number as in the
  /// JSON, and its attribute data-of the key of the value.
  void value(Place at, const Json& number, std::string_view of, std::string_view kind = "number",
             std::string_view anchor = "start");
  /// Numbers one after the other, from `at` to the right: "1, 2, 3". Returns where they end.
  Place values(Place at, const Json& numbers, std::string_view of);

  /// A short text next to a point, where no label is yet. If it is farther away, a line leads to
  /// the point. It stays within `bounds`.
  void label(Place point, std::string_view words, const Box& bounds);
  /// Keeps labels out of this box.
  void keep_clear(const Box& box) { taken_.push_back(box); }

  [[nodiscard]] double width() const { return width_; }
  [[nodiscard]] double height() const { return height_; }
  [[nodiscard]] const std::string& elements() const { return elements_; }

 private:
  void reach(double x, double y);

  std::string elements_;
  std::vector<Box> taken_;
  double width_ = 0, height_ = 0;
};

/// The pictures of several cases, one below the other, as one SVG file.
std::string document(const std::string& title, const std::vector<Picture>& pictures);

/// A part of the page that shows a part of a plane, at one scale in both directions.
class View {
 public:
  /// Shows at least `points` and their surroundings within a square of `size` at `corner`; y grows
  /// up as in mathematics, or down as in the window.
  View(const std::vector<Place>& points, Place corner, double width, double height, bool y_down);

  [[nodiscard]] Place operator()(Place p) const {
    return {left_ + (p.x - least_.x) * scale_,
            y_down_ ? top_ + (p.y - least_.y) * scale_ : top_ + (greatest_.y - p.y) * scale_};
  }
  [[nodiscard]] std::vector<Place> operator()(const std::vector<Place>& places) const;
  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] double scale() const { return scale_; }
  /// The part of the plane that is shown.
  [[nodiscard]] Place least() const { return least_; }
  [[nodiscard]] Place greatest() const { return greatest_; }

 private:
  Box box_;
  Place least_, greatest_;
  double left_ = 0, top_ = 0, scale_ = 1;
  bool y_down_;
};

/// [x, y] of an answer.
Place place_of(const Json& point);
std::vector<Place> places_of(const Json& points);

}  // namespace fathom::app::drawing
