#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/textbook/drawing/drawings.h"
#include "fathom/failures/errors.h"

namespace fathom::app::drawing {
namespace {

constexpr std::int64_t most_pixels_across = 64;
constexpr double title_height = 26;

/// Pixels as cells of the page.
class PixelGrid {
 public:
  PixelGrid(double cell, Place corner) : cell_(cell), corner_(corner) {}

  void include(double x, double y) {
    x_begin_ = std::min(x_begin_, static_cast<std::int64_t>(std::floor(x)));
    y_begin_ = std::min(y_begin_, static_cast<std::int64_t>(std::floor(y)));
    x_end_ = std::max(x_end_, static_cast<std::int64_t>(std::floor(x)) + 1);
    y_end_ = std::max(y_end_, static_cast<std::int64_t>(std::floor(y)) + 1);
  }
  void check(std::int64_t most = most_pixels_across) const {
    if (x_end_ - x_begin_ > most || y_end_ - y_begin_ > most)
      throw InputError(
          fmt::format("a picture shows at most {0} x {0} pixels here, found {1} x {2}; "
                      "\"width\" and \"height\" limit them",
                      most, x_end_ - x_begin_, y_end_ - y_begin_));
  }

  /// A place of the window.
  [[nodiscard]] Place at(double x, double y) const {
    return {corner_.x + (x - static_cast<double>(x_begin_)) * cell_,
            corner_.y + (y - static_cast<double>(y_begin_)) * cell_};
  }
  [[nodiscard]] Place centre(double x, double y) const { return at(x + 0.5, y + 0.5); }
  [[nodiscard]] Box cell(double x, double y) const {
    const Place a = at(x, y);
    return {a.x, a.y, a.x + cell_, a.y + cell_};
  }
  [[nodiscard]] Place corner() const {
    return at(static_cast<double>(x_end_), static_cast<double>(y_end_));
  }

  void draw(Picture& picture) const {
    const auto [left, top] = at(static_cast<double>(x_begin_), static_cast<double>(y_begin_));
    const auto [right, bottom] = corner();
    for (std::int64_t x = x_begin_; x <= x_end_; ++x) {
      const double at_x = at(static_cast<double>(x), 0).x;
      picture.line({at_x, top}, {at_x, bottom}, "cell");
      if (x < x_end_)
        picture.text({at_x + cell_ / 2, top - 6}, std::to_string(x), "note", "middle");
    }
    for (std::int64_t y = y_begin_; y <= y_end_; ++y) {
      const double at_y = at(0, static_cast<double>(y)).y;
      picture.line({left, at_y}, {right, at_y}, "cell");
      if (y < y_end_)
        picture.text({left - 8, at_y + cell_ / 2 + 4}, std::to_string(y), "note", "end");
    }
  }

 private:
  double cell_;
  Place corner_;
  std::int64_t x_begin_ = std::int64_t{1} << 40, y_begin_ = std::int64_t{1} << 40;
  std::int64_t x_end_ = -(std::int64_t{1} << 40), y_end_ = -(std::int64_t{1} << 40);
};

constexpr Place grid_corner{40, title_height + 24};

std::string name_of(const Json& object) {
  const auto found = object.find("name");
  return found != object.end() && found->is_string() ? found->get<std::string>() + ": " : "";
}

/// The directions of a line's steps on the page: along its major axis, and across it.
struct StepDirections {
  explicit StepDirections(const Json& line) {
    const double dx = number_of(line[2]) - number_of(line[0]),
                 dy = number_of(line[3]) - number_of(line[1]);
    const bool steep = std::abs(dy) > std::abs(dx);
    const double major = (steep ? dy : dx) < 0 ? -1 : 1, minor = (steep ? dx : dy) < 0 ? -1 : 1;
    along = steep ? Place{0, major} : Place{major, 0};
    across = steep ? Place{minor, 0} : Place{0, minor};
  }
  Place along, across;
};

/// The midpoint M between the two pixels that a step chooses from.
void draw_midpoint(Picture& picture, const PixelGrid& grid, const StepDirections& directions,
                   const Json& step) {
  const auto& [along, across] = directions;
  const Place pixel = place_of(step["pixel"]);
  const Place m = grid.centre(pixel.x + along.x + across.x / 2, pixel.y + along.y + across.y / 2);
  picture.dot(m, "dot-a", 3);
}

/// The direction of the next pixel as the page shows it, with north up: the choices "E" and "NE" of
/// an answer are the textbook's, whose y grows up and whose lines rise to the right.
std::string compass_direction(const StepDirections& directions, const Json& choice) {
  const auto& [along, across] = directions;
  const bool both = choice == "NE";
  const double x = along.x + (both ? across.x : 0), y = along.y + (both ? across.y : 0);
  return std::string(y < 0 ? "N" : y > 0 ? "S" : "") + (x < 0 ? "W" : x > 0 ? "E" : "");
}

Picture draw_line(const std::string& algorithm, const Json& object, const Json& answer) {
  Picture picture;
  PixelGrid grid(64, grid_corner);
  const Json& steps = answer["trace"]["steps"];
  for (const Json& step : steps)
    grid.include(number_of(step["pixel"][0]), number_of(step["pixel"][1]));
  const Json& line = object["line"];
  picture.text({0, 15},
               fmt::format("{}{} from ({}, {}) to ({}, {}), stepping in {}", name_of(object),
                           algorithm, shown(line[0]), shown(line[1]), shown(line[2]),
                           shown(line[3]), answer["trace"]["axis"].get<std::string>()),
               "title");
  if (steps.empty()) return picture;
  grid.check();
  for (const Json& step : steps) {
    const Place p = place_of(step["pixel"]);
    picture.rect(grid.cell(p.x, p.y), "soft");
  }
  grid.draw(picture);
  const Place a{number_of(line[0]), number_of(line[1])}, b{number_of(line[2]), number_of(line[3])};
  if (algorithm == "diamond-exit")
    picture.line(grid.at(a.x, a.y), grid.at(b.x, b.y), "b");
  else
    picture.line(grid.centre(a.x, a.y), grid.centre(b.x, b.y), "b");
  for (const Json& step : steps) {
    const Place p = place_of(step["pixel"]), c = grid.centre(p.x, p.y);
    picture.dot(c, "dot");
    double y = grid.cell(p.x, p.y).top + 15;
    for (const char* key : {"minor", "error", "d", "enters", "leaves"}) {
      if (!step.contains(key)) continue;
      picture.value({c.x, y}, step[key], key, "number", "middle");
      y = grid.cell(p.x, p.y).bottom - 7;
    }
    if (!step.contains("choice")) continue;
    const StepDirections directions(line);
    picture.text({c.x, y}, compass_direction(directions, step["choice"]), "text-a", "middle");
    draw_midpoint(picture, grid, directions, step);
  }
  const char* what =
      algorithm == "midpoint" ? "in a pixel: d, and where the next pixel is, with north up; red: "
                                "the midpoint that d is "
                                "about"
      : algorithm == "bresenham" ? "in a pixel: the error before the step"
      : algorithm == "diamond-exit"
          ? "in a pixel: the parameters at which the line enters and leaves its diamond"
          : "in a pixel: the minor coordinate before it is rounded";
  picture.text({0, grid.corner().y + 22}, what, "note");
  return picture;
}

/// "polygon" or "triangle", as rings.
Json rings_of(const Json& object) {
  return object.contains("polygon") ? object["polygon"] : Json::array({object["triangle"]});
}

Picture draw_fill(const std::string& algorithm, const Json& object, const Json& answer) {
  Picture picture;
  PixelGrid grid(28, grid_corner);
  picture.text({0, 15}, name_of(object) + algorithm + ": crossings and spans of each scan line",
               "title");
  const Json& rows = answer["trace"];
  for (const Json& row : rows) {
    for (const Json& crossing : row["crossings"])
      grid.include(number_of(crossing["x"]), number_of(row["y"]));
    for (const Json& span : row["spans"])
      if (span["x_begin"] < span["x_end"]) {
        grid.include(number_of(span["x_begin"]), number_of(row["y"]));
        grid.include(number_of(span["x_end"]) - 1, number_of(row["y"]));
      }
  }
  if (rows.empty()) return picture;
  for (const Json& ring : rings_of(object))
    for (const Json& corner : ring) grid.include(number_of(corner[0]), number_of(corner[1]));
  grid.check();
  for (const Json& row : rows)
    for (const Json& span : row["spans"])
      for (double x = number_of(span["x_begin"]); x < number_of(span["x_end"]); ++x)
        picture.rect(grid.cell(x, number_of(row["y"])), "soft");
  grid.draw(picture);
  const double right = grid.corner().x + 24;
  for (const Json& ring : rings_of(object)) {
    std::vector<Place> corners;
    for (const Place& p : places_of(ring)) corners.push_back(grid.at(p.x, p.y));
    picture.polygon(corners, "b");
  }
  for (const Json& row : rows) {
    const double y = number_of(row["y"]) + 0.5;
    picture.line({grid_corner.x, grid.at(0, y).y}, {right - 8, grid.at(0, y).y}, "thin", true);
    Json crossings = Json::array();
    for (const Json& crossing : row["crossings"]) {
      crossings.push_back(crossing["x"]);
      picture.dot(grid.at(number_of(crossing["x"]), y),
                  crossing["winding"] == 1 ? "dot-a" : "dot-c");
    }
    Place end = picture.values({right, grid.at(0, y).y + 4}, crossings, "crossings");
    for (const Json& span : row["spans"]) {
      end.x += 14;
      const std::string words =
          fmt::format("[{}, {})", shown(span["x_begin"]), shown(span["x_end"]));
      picture.text(end, words, "note");
      end.x += width_of(words);
    }
  }
  picture.text({0, grid.corner().y + 22},
               "right: the crossings of a scan line at its pixels' centres, and the pixels of its "
               "spans; red: the edge runs down, green: up",
               "note");
  return picture;
}

std::string sign_of(int sign) {
  return sign > 0 ? "+" : sign < 0 ? "\u2212" : "0";
}

/// " + 3" or " \u2212 3", as another term of a sum.
std::string added(const Json& number) {
  const std::string text = shown(number);
  return text.starts_with("-") ? " \u2212 " + text.substr(1) : " + " + text;
}

Picture draw_edge_functions(const Json& object, const Json& answer) {
  Picture picture;
  picture.text({0, 15}, name_of(object) + "edge functions at each pixel's centre", "title");
  const Json& trace = answer["trace"];
  if (trace.contains("degenerate")) {
    picture.text({0, 40}, "the triangle has no area: it covers nothing", "text");
    return picture;
  }
  PixelGrid grid(72, grid_corner);
  for (const char* list : {"samples", "rejected"})
    for (const Json& sample : trace[list])
      grid.include(number_of(sample["pixel"][0]), number_of(sample["pixel"][1]));
  if (trace["samples"].empty() && trace["rejected"].empty()) return picture;
  for (const Place& p : places_of(trace["corners"])) grid.include(p.x, p.y);
  grid.check(32);
  for (const Json& sample : trace["samples"])
    picture.rect(grid.cell(number_of(sample["pixel"][0]), number_of(sample["pixel"][1])), "soft");
  grid.draw(picture);
  std::vector<Place> corners;
  for (const Place& p : places_of(trace["corners"])) corners.push_back(grid.at(p.x, p.y));
  picture.polygon(corners, "b");
  for (const Json& sample : trace["samples"]) {
    const Box cell = grid.cell(number_of(sample["pixel"][0]), number_of(sample["pixel"][1]));
    for (std::size_t k = 0; k < 3; ++k)
      picture.value({cell.left + 6, cell.top + 20 + 20 * static_cast<double>(k)},
                    sample["edges"][k], "edges", "number");
  }
  for (const Json& sample : trace["rejected"]) {
    const Place c = grid.centre(number_of(sample["pixel"][0]), number_of(sample["pixel"][1]));
    std::string signs;
    for (const Json& sign : sample["signs"]) signs += sign_of(sign.get<int>());
    picture.text({c.x, c.y + 4}, signs, "note", "middle");
  }
  double y = grid.corner().y + 22;
  for (const Json& edge : trace["edges"]) {
    picture.text({0, y},
                 fmt::format("e_{} = {} x{} y{}   ({} edge)", edge["edge"].get<std::string>(),
                             shown(edge["a"]), added(edge["b"]), added(edge["c"]),
                             edge["kind"].get<std::string>()),
                 "text");
    y += 20;
  }
  picture.text({0, y}, "in a covered pixel: e_BC, e_CA, e_AB; in another one: their signs", "note");
  return picture;
}

/// An affine function over the image.
struct Affine {
  double a, b, c;
  [[nodiscard]] double operator()(Place p) const { return a * p.x + b * p.y + c; }
};

/// The part of a convex polygon where an affine function is at least 0.
std::vector<Place> part_above(const std::vector<Place>& polygon, const Affine& f) {
  std::vector<Place> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Place &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double fp = f(p), fq = f(q);
    if (fp >= 0) part.push_back(p);
    if ((fp > 0 && fq < 0) || (fp < 0 && fq > 0)) {
      const double t = fp / (fp - fq);
      part.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
  }
  return part;
}

/// 1, 2 or 5 times a power of ten; at most 8 such steps fit into `range`.
double step_for(double range) {
  const double power = std::pow(10, std::floor(std::log10(range / 8)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (range / (factor * power) <= 8) return factor * power;
  return 10 * power;
}

struct EdgePanel {
  Picture& picture;
  View view;
  std::vector<Place> image;  ///< its corners
  Affine f;

  void fill(const Affine& g, const char* kind) const {
    const auto part = part_above(image, g);
    if (part.size() > 2) picture.polygon(view(part), kind);
  }

  void draw() const {
    double least = f(image[0]), greatest = least;
    for (const Place& p : image) {
      least = std::min(least, f(p));
      greatest = std::max(greatest, f(p));
    }
    const double step = step_for(greatest - least);
    for (double level = 0; level < greatest; level += step) fill({f.a, f.b, f.c - level}, "band-a");
    for (double level = 0; level > least; level -= step) fill({-f.a, -f.b, level - f.c}, "band-b");
    for (double level = std::ceil(least / step) * step; level <= greatest; level += step)
      draw_level(std::abs(level) < step / 2 ? 0 : level);
  }

  /// The line on which the function has one value.
  void draw_level(double level) const {
    const auto part = part_above(image, {f.a, f.b, f.c - level});
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Place &p = part[i], &q = part[(i + 1) % part.size()];
      const double tolerance = 1e-9 * (std::abs(f.a) + std::abs(f.b));
      if (std::abs(f(p) - level) > tolerance || std::abs(f(q) - level) > tolerance) continue;
      picture.line(view(p), view(q), level == 0 ? "ink" : "thin");
    }
  }
};

/// Values at some pixels, as in the answer.
void draw_values(Picture& picture, const View& view, const Json& answer, std::size_t k,
                 std::int64_t width, std::int64_t height) {
  constexpr std::int64_t across = 4;
  for (std::int64_t j = 0; j < across; ++j) {
    for (std::int64_t i = 0; i < across; ++i) {
      const std::int64_t x = width * (2 * i + 1) / (2 * across),
                         y = height * (2 * j + 1) / (2 * across);
      const Place at = view({static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5});
      const Json& value =
          answer["values"][static_cast<std::size_t>(y)][static_cast<std::size_t>(x)][k];
      picture.dot(at, "dot", 2);
      picture.value({at.x, at.y - 6}, value, fmt::format("{},{}", x, y), "small", "middle");
    }
  }
}

/// Whether a convex polygon contains a box.
bool contains(const std::vector<Place>& polygon, const Box& box) {
  const Place corners[] = {
      {box.left, box.top}, {box.right, box.top}, {box.right, box.bottom}, {box.left, box.bottom}};
  bool some_left = false, some_right = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Place &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    for (const Place& c : corners) {
      const double side = (q.x - p.x) * (c.y - p.y) - (q.y - p.y) * (c.x - p.x);
      some_left = some_left || side < 0;
      some_right = some_right || side > 0;
    }
  }
  return some_left != some_right;
}

/// The signs in a region of the image: in its middle if they fit, else next to a dot there, within
/// `image`.
void put_signs(Picture& picture, const std::vector<Place>& region, const std::string& signs,
               const Box& image) {
  Place middle;
  for (const Place& p : region) {
    middle.x += p.x / static_cast<double>(region.size());
    middle.y += p.y / static_cast<double>(region.size());
  }
  const double width = width_of(signs), height = 14;
  const Box box{middle.x - width / 2, middle.y - height / 2, middle.x + width / 2,
                middle.y + height / 2};
  if (!contains(region, box)) {
    picture.dot(middle, "dot", 2);
    return picture.label(middle, signs, image);
  }
  picture.keep_clear(box);
  picture.text({middle.x, box.bottom - 3}, signs, "label", "middle");
}

Picture draw_edge_values(const Json& object, const Json& answer) {
  Picture picture;
  picture.text({0, 15}, name_of(object) + "the three edge functions over the image", "title");
  if (answer["values"].empty()) {
    picture.text({0, 40}, "the triangle has no area: its edge functions are 0", "text");
    return picture;
  }
  const auto height = static_cast<std::int64_t>(answer["values"].size()),
             width = static_cast<std::int64_t>(answer["values"][0].size());
  const auto w = static_cast<double>(width), h = static_cast<double>(height);
  const std::vector<Place> image{{0, 0}, {w, 0}, {w, h}, {0, h}};
  const double size = 420;
  for (std::size_t k = 0; k < 3; ++k) {
    const Json& edge = answer["edges"][k];
    const std::size_t column = k % 2, row = k / 2;
    const Place corner{static_cast<double>(column) * (size + 16),
                       title_height + 24 + static_cast<double>(row) * (size + 46)};
    // The view leaves a tenth around the image, into which the triangle may extend.
    const View view(image, corner, size, size, true);
    picture.text(
        {corner.x, corner.y - 8},
        fmt::format("e_{}: positive in red, negative in blue", edge["edge"].get<std::string>()),
        "text");
    EdgePanel{
        picture, view, image, {number_of(edge["a"]), number_of(edge["b"]), number_of(edge["c"])}}
        .draw();
    picture.polygon(view(image), "thin");
    picture.polygon(view(places_of(object["triangle"])), "c");
    draw_values(picture, view, answer, k, width, height);
  }
  // The seven regions, each with its signs.
  const Place corner{size + 16, title_height + 24 + size + 46};
  const View view(image, corner, size, size, true);
  picture.text({corner.x, corner.y - 8}, "the signs of e_BC, e_CA, e_AB", "text");
  constexpr const char* kinds[] = {"fill-a", "fill-b", "fill-c"};
  for (std::size_t k = 0; k < 3; ++k) {
    const Json& edge = answer["edges"][k];
    const auto part =
        part_above(image, {number_of(edge["a"]), number_of(edge["b"]), number_of(edge["c"])});
    if (part.size() > 2) picture.polygon(view(part), kinds[k]);
  }
  picture.polygon(view(image), "thin");
  picture.polygon(view(places_of(object["triangle"])), "ink");
  const Place upper_left = view(image[0]), lower_right = view(image[2]);
  const Box page_image{upper_left.x, upper_left.y, lower_right.x, lower_right.y};
  for (int region = 0; region < 8; ++region) {
    std::vector<Place> part = image;
    std::string signs;
    for (std::size_t k = 0; k < 3; ++k) {
      const Json& edge = answer["edges"][k];
      const double side = (region >> k & 1) != 0 ? -1 : 1;
      part = part_above(part, {side * number_of(edge["a"]), side * number_of(edge["b"]),
                               side * number_of(edge["c"])});
      signs += sign_of(static_cast<int>(side));
    }
    if (part.size() > 2) put_signs(picture, view(part), signs, page_image);
  }
  return picture;
}

}  // namespace

Picture draw_scan(const std::string& algorithm, const Json& object, const Json& answer) {
  if (algorithm == "edge-values") return draw_edge_values(object, answer);
  if (algorithm == "edge-function") return draw_edge_functions(object, answer);
  if (object.contains("line")) return draw_line(algorithm, object, answer);
  return draw_fill(algorithm, object, answer);
}

}  // namespace fathom::app::drawing
