#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/textbook/drawing/drawings.h"
#include "fathom/failures/errors.h"

namespace fathom::app::drawing {
namespace {

constexpr double panel_size = 260, panel_gap = 28, caption_height = 18;
constexpr double page_width = 1200;
constexpr std::size_t most_step_panels = 64;

std::string title_of(const Json& object, const std::string& words) {
  const auto found = object.find("name");
  return found != object.end() && found->is_string() ? found->get<std::string>() + ": " + words
                                                     : words;
}

/// Panels from left to right, row by row; a row is as high as its highest caption. `pitch` is from
/// panel to panel: captions may be wider than the panels.
class Panels {
 public:
  Panels(Picture& picture, std::size_t count, double top, double pitch = panel_size + panel_gap)
      : picture_(picture), top_(top), pitch_(pitch) {
    if (count > most_step_panels)
      throw InputError(
          fmt::format("a picture shows at most {} steps, found {}", most_step_panels, count));
  }

  /// The upper left corner of the next panel.
  Place next() {
    if (static_cast<double>(column_ + 1) * pitch_ > page_width) {
      column_ = 0;
      top_ = picture_.height() + panel_gap;
    }
    return {static_cast<double>(column_++) * pitch_, top_};
  }

 private:
  Picture& picture_;
  double top_, pitch_;
  std::size_t column_ = 0;
};

/// "(x, y)" with both numbers as those of the answer; returns where it ends.
Place put_point(Picture& picture, Place at, const Json& point, std::string_view of) {
  picture.text(at, "(", "number");
  at.x += width_of("(");
  at = picture.values(at, point, of);
  picture.text(at, ")", "number");
  return {at.x + width_of(")"), at.y};
}

/// The corners of a polygon, numbered, in the panel; their coordinates below it.
void put_corners(Picture& picture, const View& view, Place below, const Json& polygon,
                 std::string_view of) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    picture.dot(view(place_of(polygon[i])), "dot", 2.5);
  std::map<std::pair<double, double>, std::string> numbers;  // a corner may be there twice
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    std::string& list = numbers[{number_of(polygon[i][0]), number_of(polygon[i][1])}];
    list += (list.empty() ? "" : ",") + std::to_string(i + 1);
  }
  for (const auto& [point, words] : numbers)
    picture.label(view({point.first, point.second}), words, view.box());
  for (std::size_t i = 0; i < polygon.size(); ++i, below.y += caption_height) {
    const std::string number = std::to_string(i + 1) + "  ";
    picture.text(below, number, "note");
    put_point(picture, {below.x + 28, below.y}, polygon[i], of);
  }
}

/// An axis of parameters: which boundary is passed where.
void put_parameters(Picture& picture, Place at, const Json& trace) {
  const double left = at.x + 260, width = 380;
  double least = 0, greatest = 1;
  for (const Json& p : trace["parameters"])
    if (p.contains("t")) {
      least = std::min(least, number_of(p["t"]));
      greatest = std::max(greatest, number_of(p["t"]));
    }
  const auto place = [&](double t) { return left + width * (t - least) / (greatest - least); };
  const double top = at.y - 4;
  for (const Json& p : trace["parameters"]) {
    at.y += 24;
    picture.text({at.x, at.y}, p["edge"].get<std::string>() + ": " + p["kind"].get<std::string>(),
                 "text");
    if (!p.contains("t")) continue;
    picture.text({at.x + 170, at.y}, "t =", "note");
    picture.value({at.x + 195, at.y}, p["t"], "t");
    picture.line({left, at.y - 4}, {left + width, at.y - 4}, "cell");
    picture.dot({place(number_of(p["t"])), at.y - 4}, p["kind"] == "entering" ? "dot-a" : "dot-b",
                4.5);
  }
  for (const double t : {0.0, 1.0}) {
    picture.line({place(t), top + 8}, {place(t), at.y + 10}, "thin", true);
    picture.text({place(t), top + 4}, t == 0 ? "0" : "1", "note", "middle");
  }
  at.y += 28;
  picture.text(at, "t_entering =", "text");
  picture.value({at.x + 100, at.y}, trace["t_entering"], "t_entering");
  picture.text({at.x + 200, at.y}, "t_leaving =", "text");
  picture.value({at.x + 300, at.y}, trace["t_leaving"], "t_leaving");
}

Picture draw_segment(const std::string& algorithm, const Json& object, const Json& answer) {
  Picture picture;
  picture.text({0, 15}, title_of(object, algorithm), "title");
  const Json& w = object["window"];
  const Place least{number_of(w[0]), number_of(w[1])}, greatest{number_of(w[2]), number_of(w[3])};
  const std::vector<Place> window{least, {greatest.x, least.y}, greatest, {least.x, greatest.y}};
  std::vector<Place> all = window;
  for (const Place& p : places_of(object["segment"])) all.push_back(p);
  const bool outcodes = algorithm == "cohen-sutherland";
  const Json steps = outcodes ? answer["trace"] : Json::array({answer["trace"]});
  Panels panels(picture, steps.size(), 32);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Place corner = panels.next();
    const View view(all, corner, panel_size, panel_size, false);
    const std::vector<Place> whole = places_of(object["segment"]);
    // The lines of the window's sides divide the plane into the nine regions of the outcodes.
    for (const double x : {least.x, greatest.x})
      picture.line(view({x, view.least().y}), view({x, view.greatest().y}), "cell");
    for (const double y : {least.y, greatest.y})
      picture.line(view({view.least().x, y}), view({view.greatest().x, y}), "cell");
    picture.polygon(view(window), "soft");
    picture.polygon(view(window), "ink");
    picture.line(view(whole[0]), view(whole[1]), "thin", true);
    const Json& segment = outcodes ? steps[i]["segment"] : answer["segment"];
    if (!segment.is_null()) {
      const std::vector<Place> ends = places_of(segment);
      picture.line(view(ends[0]), view(ends[1]), "b");
      for (std::size_t k = 0; k < 2; ++k) picture.dot(view(ends[k]), "dot");
      picture.label(view(ends[0]), outcodes ? "E1" : "start", view.box());
      picture.label(view(ends[1]), outcodes ? "E2" : "end", view.box());
    }
    if (!outcodes) {
      put_parameters(picture, {0, corner.y + panel_size + 26}, steps[i]);
      continue;
    }
    const Json& step = steps[i];
    Place at{corner.x, corner.y + panel_size + caption_height};
    const auto code = [&](const char* label, const Json& bits) {
      picture.text(at, label, "note");
      picture.text({at.x + 40, at.y}, bits.get<std::string>(), "number");
    };
    for (std::size_t k = 0; k < 2; ++k) {
      code(k == 0 ? "E1" : "E2", step["outcodes"][k]);
      put_point(picture, {at.x + 84, at.y}, step["segment"][k], "segment");
      at.y += caption_height;
    }
    code("AND", step["and"]);
    at.y += caption_height;
    std::string verdict =
        fmt::format("test {}: {}", step["test"].dump(), step["verdict"].get<std::string>());
    if (step.contains("edge"))
      verdict += fmt::format(" at {}, {} moves", step["edge"].get<std::string>(),
                             step["moved"].get<std::string>());
    picture.text(at, verdict, "text-a");
  }
  return picture;
}

/// The polygon after each edge of the clip ring.
Picture draw_sutherland_hodgman(const Json& object, const Json& answer) {
  Picture picture;
  picture.text({0, 15}, title_of(object, "sutherland-hodgman: the polygon after each edge"),
               "title");
  std::vector<Place> all;
  for (const char* side : {"subject", "clip"})
    for (const Json& ring : object[side])
      for (const Place& p : places_of(ring)) all.push_back(p);
  Panels panels(picture, answer["trace"].size(), 32);
  for (const Json& step : answer["trace"]) {
    const Place corner = panels.next();
    const View view(all, corner, panel_size, panel_size, false);
    for (const Json& ring : object["subject"]) picture.polygon(view(places_of(ring)), "thin");
    for (const Json& ring : object["clip"]) picture.polygon(view(places_of(ring)), "thin");
    const std::vector<Place> polygon = places_of(step["polygon"]);
    if (!polygon.empty()) {
      picture.polygon(view(polygon), "fill-b");
      picture.polygon(view(polygon), "b");
    }
    const std::vector<Place> edge = places_of(step["edge"]);
    picture.line(view(edge[0]), view(edge[1]), "a");
    Place below{corner.x, corner.y + panel_size + caption_height};
    picture.text(below,
                 fmt::format("{} {}", step.contains("piece") ? "piece" : "ring",
                             step[step.contains("piece") ? "piece" : "ring"].dump()),
                 "note");
    below.y += caption_height;
    picture.text(below, "edge", "text-a");
    put_point(picture, put_point(picture, {below.x + 40, below.y}, step["edge"][0], "edge"),
              step["edge"][1], "edge");
    below.y += caption_height;
    if (polygon.empty()) picture.text(below, "nothing is left", "text");
    put_corners(picture, view, below, step["polygon"], "polygon");
  }
  return picture;
}

/// Which coordinate a boundary of the view volume is about.
std::size_t coordinate_of(const std::string& plane) {
  return plane == "left" || plane == "right" ? 0 : plane == "bottom" || plane == "top" ? 1 : 2;
}

/// The polygon after each boundary, drawn over the coordinate that the boundary is about and w: the
/// hourglass of the visible points lies between the lines through the origin.
Picture draw_homogeneous(const Json& object, const Json& answer) {
  constexpr const char* names = "xyz";
  Picture picture;
  picture.text({0, 15}, title_of(object, "homogeneous: the polygon after each boundary, w upwards"),
               "title");
  const bool zero_one = object.value("volume", "opengl") == "zero-one";
  Panels panels(picture, answer["trace"].size(), 32, 390);
  for (const Json& step : answer["trace"]) {
    const std::string plane = step["plane"].get<std::string>();
    const std::size_t k = coordinate_of(plane);
    const auto in_panel = [&](const Json& points) {
      std::vector<Place> places;
      for (const Json& p : points) places.push_back({number_of(p[k]), number_of(p[3])});
      return places;
    };
    std::vector<Place> all = in_panel(object["polygon"]);
    all.push_back({0, 0});
    for (const Place& p : in_panel(step["polygon"])) all.push_back(p);
    const Place corner = panels.next();
    const View view(all, corner, panel_size, panel_size, false);
    const double reach = std::max(std::abs(view.least().y), std::abs(view.greatest().y));
    const double low = k == 2 && zero_one ? 0 : -1;
    // Both boundaries of this coordinate, as long as the panel is high.
    for (const double slope : {low, 1.0}) {
      const double down = std::min(0.0, view.least().y), up = std::max(0.0, view.greatest().y);
      const auto inside = [&](double w) {
        const double limit =
            slope == 0 ? reach
                       : std::min(std::abs(w), slope * w > 0 ? view.greatest().x : -view.least().x);
        return slope == 0 ? w : std::copysign(limit, w);
      };
      picture.line(
          view({slope * inside(down), inside(down)}), view({slope * inside(up), inside(up)}),
          (slope == 1) == (plane == "right" || plane == "top" || plane == "far") ? "a" : "thin");
    }
    picture.line(view({view.least().x, 0}), view({view.greatest().x, 0}), "cell");
    const auto before = in_panel(object["polygon"]), after = in_panel(step["polygon"]);
    picture.polygon(view(before), "thin");
    if (!after.empty()) {
      picture.polygon(view(after), "fill-b");
      picture.polygon(view(after), "b");
    }
    Place below{corner.x, corner.y + panel_size + caption_height};
    picture.text(
        below,
        fmt::format("{}{}: {} to the right", plane,
                    step.contains("half") ? ", " + step["half"].get<std::string>() + " half"
                                          : std::string(),
                    names[k]),
        "text-a");
    below.y += caption_height;
    if (after.empty()) picture.text(below, "nothing is left", "text");
    for (std::size_t i = 0; i < after.size(); ++i, below.y += caption_height) {
      picture.dot(view(after[i]), "dot", 2.5);
      put_point(picture, below, step["polygon"][i], "polygon");
    }
  }
  return picture;
}

/// A polygon in space, seen a little from above: x to the right, y up, z to the back.
Place oblique(const Json& p) {
  return {number_of(p[0]) + 0.5 * number_of(p[2]), number_of(p[1]) + 0.35 * number_of(p[2])};
}

Picture draw_in_space(const std::string& algorithm, const Json& object, const Json& answer) {
  Picture picture;
  picture.text({0, 15},
               title_of(object, algorithm + ": the polygon after each plane, z to the back"),
               "title");
  const auto places = [](const Json& points) {
    std::vector<Place> result;
    for (const Json& p : points) result.push_back(oblique(p));
    return result;
  };
  Panels panels(picture, answer["trace"].size(), 32, 300);
  for (const Json& step : answer["trace"]) {
    const Place corner = panels.next();
    const View view(places(object["polygon3"]), corner, panel_size, panel_size, false);
    picture.polygon(view(places(object["polygon3"])), "thin");
    const auto after = places(step["polygon3"]);
    if (!after.empty()) {
      picture.polygon(view(after), "fill-b");
      picture.polygon(view(after), "b");
    }
    Place below{corner.x, corner.y + panel_size + caption_height};
    const std::string words = fmt::format("plane {} ", step["plane"].dump());
    picture.text(below, words, "text-a");
    picture.values({below.x + width_of(words), below.y},
                   object["planes"][step["plane"].get<std::size_t>()], "plane");
    below.y += caption_height;
    if (after.empty()) picture.text(below, "nothing is left", "text");
    for (std::size_t i = 0; i < after.size(); ++i, below.y += caption_height) {
      picture.dot(view(after[i]), "dot", 2.5);
      put_point(picture, below, step["polygon3"][i], "polygon3");
    }
  }
  return picture;
}

const char* kind_of_dot(const Json& place) {
  if (!place.contains("kind")) return "dot";
  const std::string kind = place["kind"].get<std::string>();
  return kind == "entering" ? "dot-a" : kind == "leaving" ? "dot-c" : "dot-d";
}

/// A list of one side as rows of text. Returns where it ends, and where each crossing stands.
double put_list(Picture& picture, Place at, const char* side, const Json& rings,
                std::map<std::size_t, Place>& crossings,
                const std::map<std::string, int>& numbers) {
  picture.text(at, std::string(side) + " list",
               side == std::string("subject") ? "text-b" : "text-c");
  at.y += caption_height + 4;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    picture.text(at, "ring " + std::to_string(r), "note");
    at.y += caption_height;
    for (const Json& place : rings[r]) {
      picture.dot({at.x + 4, at.y - 4}, kind_of_dot(place), 4);
      picture.text({at.x + 14, at.y}, std::to_string(numbers.at(place["point"].dump())), "text");
      const Place end = put_point(picture, {at.x + 40, at.y}, place["point"], side);
      std::string words = place.contains("kind") ? place["kind"].get<std::string>() : "";
      if (place.contains("crossing")) {
        words += " #" + place["crossing"].dump();
        crossings[place["crossing"].get<std::size_t>()] = {at.x, at.y - 4};
      }
      picture.text({end.x + 8, at.y}, words, "note");
      at.y += caption_height;
    }
  }
  return at.y;
}

constexpr double list_width = 330;

/// Both polygons with their numbered places.
void put_polygons(Picture& picture, const View& view, const Json& trace,
                  const std::map<std::string, int>& numbers, bool with_labels) {
  for (const char* side : {"subject", "clip"})
    for (const Json& ring : trace[side]) {
      std::vector<Place> corners;
      for (const Json& place : ring) corners.push_back(view(place_of(place["point"])));
      if (with_labels)
        picture.polygon(corners, side == std::string("subject") ? "fill-b" : "fill-c");
      picture.polygon(corners, !with_labels ? "thin" : side == std::string("subject") ? "b" : "c");
    }
  std::map<std::string, const Json*> places;
  for (const char* side : {"subject", "clip"})
    for (const Json& ring : trace[side])
      for (const Json& place : ring) {
        const Json*& known = places[place["point"].dump()];
        if (known == nullptr || place.contains("kind")) known = &place;
      }
  if (!with_labels) return;
  constexpr double radius = 4;
  for (const auto& [text, place] : places) {
    const Place at = view(place_of((*place)["point"]));
    picture.dot(at, kind_of_dot(*place), radius);
    picture.keep_clear({at.x - radius, at.y - radius, at.x + radius, at.y + radius});
  }
  for (const auto& [text, place] : places)
    picture.label(view(place_of((*place)["point"])), std::to_string(numbers.at(text)), view.box());
}

Picture draw_weiler_atherton(const Json& object, const Json& answer) {
  Picture picture;
  const Json& trace = answer["trace"];
  picture.text({0, 15},
               title_of(object, "weiler-atherton, " + object.value("op", "intersection") +
                                    ": both lists, and the walks"),
               "title");
  // Points are numbered as they come in the lists.
  std::map<std::string, int> numbers;
  std::vector<Place> all;
  for (const char* side : {"subject", "clip"})
    for (const Json& ring : trace[side])
      for (const Json& place : ring) {
        numbers.emplace(place["point"].dump(), static_cast<int>(numbers.size()) + 1);
        all.push_back(place_of(place["point"]));
      }
  if (all.empty()) return picture;
  if (numbers.size() > 100)
    throw InputError(
        fmt::format("a picture shows at most 100 corners and contacts, found {}", numbers.size()));
  const View view(all, {0, 32}, 420, 420, false);
  put_polygons(picture, view, trace, numbers, true);
  picture.text({0, 470},
               "blue: subject; green: clip; dots: red entering, green leaving, yellow touching",
               "note");
  std::map<std::size_t, Place> of_subject, of_clip;
  const double left = 450;
  const double end_of_subject =
      put_list(picture, {left, 46}, "subject", trace["subject"], of_subject, numbers);
  const double end_of_clip =
      put_list(picture, {left + list_width + 40, 46}, "clip", trace["clip"], of_clip, numbers);
  for (const auto& [crossing, from] : of_subject)
    if (of_clip.contains(crossing))
      picture.line({left + list_width - 6, from.y}, {of_clip[crossing].x - 8, of_clip[crossing].y},
                   "thin", true);
  Panels panels(picture, trace["walks"].size(), std::max({490.0, end_of_subject, end_of_clip}) + 12,
                400);
  for (std::size_t i = 0; i < trace["walks"].size(); ++i) {
    const Json& walk = trace["walks"][i];
    const Place corner = panels.next();
    const View small(all, corner, panel_size, panel_size, false);
    put_polygons(picture, small, trace, numbers, false);
    Place below{corner.x, corner.y + panel_size + caption_height};
    picture.text(below, fmt::format("walk {}", i + 1), "text");
    for (std::size_t k = 0; k < walk.size(); ++k) {
      const Json &step = walk[k], &next = walk[(k + 1) % walk.size()];
      const bool along_subject = step["along"] == "subject";
      picture.arrow(small(place_of(step["from"])), small(place_of(next["from"])),
                    along_subject ? "b" : "c");
      below.y += caption_height;
      std::string words = fmt::format("from {}", numbers.at(step["from"].dump()));
      picture.text(below, words, "text");
      const Place end = put_point(picture, {below.x + 62, below.y}, step["from"], "walk");
      words = "along " + step["along"].get<std::string>();
      if (step.contains("crossing")) words += " from #" + step["crossing"].dump();
      picture.text({end.x + 8, below.y}, words, along_subject ? "text-b" : "text-c");
    }
  }
  return picture;
}

}  // namespace

Picture draw_clip(const std::string& algorithm, const Json& object, const Json& answer) {
  if (object.contains("polygon3")) return draw_in_space(algorithm, object, answer);
  if (algorithm == "cohen-sutherland" || algorithm == "liang-barsky")
    return draw_segment(algorithm, object, answer);
  if (algorithm == "sutherland-hodgman") return draw_sutherland_hodgman(object, answer);
  if (algorithm == "weiler-atherton") return draw_weiler_atherton(object, answer);
  if (algorithm == "homogeneous" && object.contains("polygon"))
    return draw_homogeneous(object, answer);
  throw InputError(algorithm + " has no picture of this case; it draws polygons");
}

}  // namespace fathom::app::drawing
