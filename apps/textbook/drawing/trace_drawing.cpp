#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/textbook/drawing/drawings.h"
#include "fathom/failures/errors.h"

namespace fathom::app::drawing {
namespace {

constexpr double row_height = 20;
constexpr std::size_t most_fragments_across = 32, most_panels = 120;

std::vector<Place> window_corners(const Json& trace) {
  std::vector<Place> corners;
  for (const Json& corner : trace["clipping"]) corners.push_back(place_of(corner["window"]));
  return corners;
}

void put_outline(Picture& picture, const std::vector<Place>& corners) {
  if (corners.size() > 2) {
    picture.polygon(corners, "fill-b");
    picture.polygon(corners, "b");
  } else if (corners.size() == 2) {
    picture.line(corners[0], corners[1], "b");
  }
  for (const Place& p : corners) picture.dot(p, "dot-b");
}

constexpr double window_size = 520, inset_size = 260;

/// The smallest box around these places, of which there is at least one.
Box box_about(const std::vector<Place>& places) {
  Box box{places[0].x, places[0].y, places[0].x, places[0].y};
  for (const Place& p : places)
    box = {std::min(box.left, p.x), std::min(box.top, p.y), std::max(box.right, p.x),
           std::max(box.bottom, p.y)};
  return box;
}

std::vector<Place> corners_of(const Box& box) {
  return {
      {box.left, box.top}, {box.right, box.top}, {box.right, box.bottom}, {box.left, box.bottom}};
}

Box common_part(const Box& a, const Box& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
          std::min(a.bottom, b.bottom)};
}

/// The part of the window in the large panel: the whole window, or the surroundings of a primitive
/// that would be small in it.
Box shown_part(const std::vector<Place>& corners, const Box& window) {
  if (corners.empty()) return window;
  constexpr double least_across = 4;
  Box part = box_about(corners);
  const Box inside = common_part(part, window);
  if (inside.left > inside.right || inside.top > inside.bottom) return window;
  if (2 * (part.right - part.left) > window.right || 2 * (part.bottom - part.top) > window.bottom)
    return window;
  const double x = (part.left + part.right) / 2, y = (part.top + part.bottom) / 2;
  return {std::min(part.left, x - least_across / 2), std::min(part.top, y - least_across / 2),
          std::max(part.right, x + least_across / 2), std::max(part.bottom, y + least_across / 2)};
}

/// The part of the window that a view shows.
Box visible_part(const View& view, const Box& window) {
  return common_part(window,
                     {view.least().x, view.least().y, view.greatest().x, view.greatest().y});
}

/// Lines between pixels, and the pixels' numbers, if pixels are large enough.
void put_pixel_grid(Picture& picture, const View& view, const Box& part) {
  constexpr double least_cell = 6, least_gap = 44;
  if (view.scale() < least_cell) return;
  const double step = std::ceil(least_gap / view.scale());
  const Place corner = view({part.left, part.top});
  for (double x = std::ceil(part.left); x <= part.right; ++x) {
    picture.line(view({x, part.top}), view({x, part.bottom}), "cell");
    if (std::fmod(x, step) == 0 && x + 1 <= part.right)
      picture.text({view({x + 0.5, 0}).x, corner.y - 6}, fmt::format("{:g}", x), "note", "middle");
  }
  for (double y = std::ceil(part.top); y <= part.bottom; ++y) {
    picture.line(view({part.left, y}), view({part.right, y}), "cell");
    if (std::fmod(y, step) == 0 && y + 1 <= part.bottom)
      picture.text({corner.x - 6, view({0, y + 0.5}).y + 4}, fmt::format("{:g}", y), "note", "end");
  }
}

/// The traced pixel's centre, as a cross.
void put_pixel(Picture& picture, const View& view, const Json& trace) {
  const Json merger = trace.value("output_merger", Json::array());
  if (merger.empty()) return;
  const Place centre =
      view({number_of(merger[0]["pixel"][0]) + 0.5, number_of(merger[0]["pixel"][1]) + 0.5});
  const Box& box = view.box();
  if (centre.x < box.left || centre.x > box.right || centre.y < box.top || centre.y > box.bottom)
    return;
  picture.line({centre.x - 8, centre.y}, {centre.x + 8, centre.y}, "a");
  picture.line({centre.x, centre.y - 8}, {centre.x, centre.y + 8}, "a");
}

/// The whole window, small, with a frame about the part that the large panel shows.
void put_inset(Picture& picture, const Json& trace, const Box& window, const Box& part, Place at) {
  picture.text(at, "red frame: the part shown on the left", "note");
  const View view(corners_of(window), {at.x, at.y + 8}, inset_size,
                  inset_size * std::min(1.0, window.bottom / window.right), true);
  picture.polygon(view(corners_of(window)), "soft");
  put_pixel(picture, view, trace);
  constexpr double least_frame = 10;
  Box frame = box_about(view(corners_of(part)));
  const double x = (frame.left + frame.right) / 2, y = (frame.top + frame.bottom) / 2;
  frame = {std::min(frame.left, x - least_frame / 2), std::min(frame.top, y - least_frame / 2),
           std::max(frame.right, x + least_frame / 2), std::max(frame.bottom, y + least_frame / 2)};
  picture.rect(frame, "a");
}

/// The clipped primitive in the image.
Picture draw_window(const Json& trace, double width, double height) {
  Picture picture;
  picture.text(
      {0, 15},
      fmt::format("{} {} in the window of {:g} x {:g} pixels",
                  trace["primitive"].get<std::string>(), trace["number"].dump(), width, height),
      "title");
  const Box window{0, 0, width, height};
  const std::vector<Place> corners = window_corners(trace);
  const Box part = shown_part(corners, window);
  const bool is_whole = part.right - part.left == width;
  // A part has the numbers of its pixels above and on the left.
  const View view = is_whole ? View(corners_of(window), {0, 24}, window_size,
                                    window_size * std::min(1.0, height / width), true)
                             : View(corners_of(part), {44, 44}, window_size, window_size, true);
  const Box visible = visible_part(view, window);
  picture.polygon(view(corners_of(visible)), "soft");
  if (!is_whole) put_pixel_grid(picture, view, visible);
  put_outline(picture, view(corners));
  for (std::size_t i = 0; i < corners.size(); ++i)
    picture.label(view(corners[i]), std::to_string(i + 1), view.box());
  put_pixel(picture, view, trace);
  if (!is_whole)
    put_inset(picture, trace, window, visible, {view.box().right + 30, view.box().top + 12});
  double y = view.box().bottom + row_height;
  if (corners.empty()) picture.text({0, y}, "clipping leaves nothing of it", "text");
  for (std::size_t i = 0; i < corners.size(); ++i, y += row_height) {
    const Json& corner = trace["clipping"][i];
    picture.text({0, y}, fmt::format("{}  clip", i + 1), "note");
    Place end = picture.values({52, y}, corner["clip"], "clip");
    picture.text({end.x + 14, y}, "NDC", "note");
    end = picture.values({end.x + 48, y}, corner["ndc"], "ndc");
    picture.text({end.x + 14, y}, "window", "note");
    picture.values({end.x + 70, y}, corner["window"], "window");
  }
  if (trace.contains("facing") && trace["facing"].contains("window"))
    picture.text({0, y},
                 fmt::format("facing: {}{}", trace["facing"]["window"].get<std::string>(),
                             trace.value("culled", false) ? ", culled" : ""),
                 "text");
  return picture;
}

/// The fragments as pixels, each with its window depth.
Picture draw_fragments(const Json& trace) {
  Picture picture;
  const Json& list = trace["fragment_list"];
  picture.text({0, 15}, fmt::format("{} fragments and their window depths", list.size()), "title");
  std::int64_t x_begin = list[0]["pixel"][0], x_end = x_begin, y_begin = list[0]["pixel"][1],
               y_end = y_begin;
  for (const Json& f : list) {
    x_begin = std::min(x_begin, f["pixel"][0].get<std::int64_t>());
    x_end = std::max(x_end, f["pixel"][0].get<std::int64_t>() + 1);
    y_begin = std::min(y_begin, f["pixel"][1].get<std::int64_t>());
    y_end = std::max(y_end, f["pixel"][1].get<std::int64_t>() + 1);
  }
  if (static_cast<std::size_t>(std::max(x_end - x_begin, y_end - y_begin)) > most_fragments_across)
    throw InputError(fmt::format(
        "--draw: a picture shows fragments of at most {0} x {0} pixels, found {1} x {2}; leave "
        "--fragments out, or limit them with --scissor",
        most_fragments_across, x_end - x_begin, y_end - y_begin));
  constexpr double cell = 72, left = 40, top = 50;
  const auto at = [&](double x, double y) {
    return Place{left + (x - static_cast<double>(x_begin)) * cell,
                 top + (y - static_cast<double>(y_begin)) * cell};
  };
  for (const Json& f : list) {
    const Place corner = at(number_of(f["pixel"][0]), number_of(f["pixel"][1]));
    picture.rect({corner.x, corner.y, corner.x + cell, corner.y + cell}, "soft");
    picture.rect({corner.x, corner.y, corner.x + cell, corner.y + cell}, "cell");
    picture.swatch({corner.x + 6, corner.y + 8, corner.x + cell - 6, corner.y + 26}, f["colour"]);
    picture.value({corner.x + cell / 2, corner.y + 50}, f["window_z"], "window_z", "number",
                  "middle");
  }
  for (std::int64_t x = x_begin; x < x_end; ++x)
    picture.text({at(static_cast<double>(x), 0).x + cell / 2, top - 6}, std::to_string(x), "note",
                 "middle");
  for (std::int64_t y = y_begin; y < y_end; ++y)
    picture.text({left - 8, at(0, static_cast<double>(y)).y + cell / 2 + 4}, std::to_string(y),
                 "note", "end");
  return picture;
}

std::string name_of_primitive(const Json& primitive) {
  return primitive.is_null() ? "background" : "primitive " + primitive.dump();
}

/// For each fragment: the pixel before it, the test, the blend, the pixel after it.
Picture draw_merger(const Json& trace) {
  Picture picture;
  const Json& merger = trace["output_merger"];
  picture.text({0, 15},
               fmt::format("the output merger at pixel {}, {}, in drawing order",
                           merger[0]["pixel"][0].dump(), merger[0]["pixel"][1].dump()),
               "title");
  constexpr double columns[] = {0, 210, 420, 640};
  constexpr const char* headings[] = {"in the pixel", "the fragment", "tests and blend",
                                      "then in the pixel"};
  double y = 44;
  for (std::size_t i = 0; i < 4; ++i) picture.text({columns[i], y}, headings[i], "note");
  y += 12;
  const auto sample = [&](double x, const Json& colour, const Json& stored, const std::string& of) {
    picture.swatch({x, y + 4, x + 34, y + 38}, colour);
    picture.text({x + 42, y + 17}, of, "text");
    picture.value({x + 42, y + 35}, stored["value"], "stored");
  };
  for (const Json& step : merger) {
    const bool own = step["primitive"] == trace["number"];
    if (own) picture.rect({-6, y - 2, 850, y + 44}, "soft");
    sample(columns[0], step["before"]["colour"], step["before"]["stored"],
           name_of_primitive(step["before"]["primitive"]));
    sample(columns[1], step["fragment"]["colour"], step["fragment"]["stored"],
           name_of_primitive(step["primitive"]));
    const std::string outcome = step["tests"]["outcome"].get<std::string>();
    picture.text({columns[2], y + 17}, step["tests"]["depth"].get<std::string>() + ": " + outcome,
                 outcome == "passed" ? "text-c" : "text-a");
    if (!step["blend"].is_null()) {
      picture.text({columns[2], y + 35}, "blend, alpha", "note");
      picture.value({columns[2] + 86, y + 35}, step["blend"]["alpha"], "alpha");
    }
    sample(columns[3], step["after"]["colour"], step["after"]["stored"],
           name_of_primitive(step["after"]["primitive"]));
    y += 54;
  }
  return picture;
}

std::string words_of(const Json& step) {
  const std::string kind = step["step"].get<std::string>();
  if (kind == "painted") return "paint " + step["P"].dump();
  if (kind == "moved") return fmt::format("try {} before {}", step["Q"].dump(), step["P"].dump());
  if (kind == "split")
    return fmt::format("split {} into {} behind, {} before", step["cut"].dump(),
                       step["behind"].dump(), step["before"].dump());
  if (kind == "kept") return fmt::format("keep {} before {}", step["P"].dump(), step["Q"].dump());
  return fmt::format("{} before {}:", step["P"].dump(), step["Q"].dump());
}

/// The painter's list step by step: painted polygons are filled, polygons of the step are outlined.
Picture draw_painter(const Json& painter) {
  Picture picture;
  const Json &polygons = painter["polygons"], &steps = painter["steps"];
  if (steps.size() > most_panels)
    throw InputError(
        fmt::format("--draw: a picture shows at most {} steps of the painter, found {}",
                    most_panels, steps.size()));
  picture.text({0, 15},
               fmt::format(
                   "the painter's order: {} polygons in the end, {} steps",
                   [&] {
                     std::set<std::size_t> cut;
                     for (const Json& polygon : polygons)
                       if (polygon.contains("part_of"))
                         cut.insert(polygon["part_of"].get<std::size_t>());
                     return polygons.size() - cut.size();
                   }(),
                   steps.size()),
               "title");
  std::vector<std::vector<Place>> outlines;
  std::vector<Place> all;
  for (const Json& polygon : polygons) {
    outlines.push_back(places_of(polygon["corners"]));
    all.insert(all.end(), outlines.back().begin(), outlines.back().end());
  }
  constexpr double size = 200, gap = 30, caption = 44, pitch = 270;
  constexpr std::size_t across = 4;
  std::vector<std::size_t> painted;
  std::set<std::size_t> shown_polygons;
  for (std::size_t i = 0; i < polygons.size(); ++i)
    if (!polygons[i].contains("part_of")) shown_polygons.insert(i);
  constexpr const char* fills[] = {"fill-b", "fill-c", "fill-d", "fill-a"};
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const Json& step = steps[s];
    const std::size_t row = s / across;
    const Place corner{static_cast<double>(s % across) * pitch,
                       30 + static_cast<double>(row) * (size + caption + gap)};
    const View view(all, corner, size, size, true);
    if (step["step"] == "split") {
      shown_polygons.erase(step["cut"].get<std::size_t>());
      shown_polygons.insert({step["behind"].get<std::size_t>(), step["before"].get<std::size_t>()});
    }
    if (step["step"] == "painted") painted.push_back(step["P"].get<std::size_t>());
    for (const std::size_t i : painted)
      picture.polygon(view(outlines[i]), fills[polygons[i]["triangle"].get<std::size_t>() % 4]);
    std::set<std::size_t> named{step["P"].get<std::size_t>()};
    if (step.contains("Q")) named.insert(step["Q"].get<std::size_t>());
    if (step["step"] == "split")
      named = {step["behind"].get<std::size_t>(), step["before"].get<std::size_t>()};
    for (const std::size_t i : shown_polygons)
      picture.polygon(view(outlines[i]), named.contains(i) ? "a" : "thin");
    for (const std::size_t i : named) {
      Place middle;
      for (const Place& p : outlines[i]) {
        middle.x += p.x / static_cast<double>(outlines[i].size());
        middle.y += p.y / static_cast<double>(outlines[i].size());
      }
      picture.label(view(middle), std::to_string(i), view.box());
    }
    picture.text({corner.x, corner.y + size + 16}, fmt::format("{}. {}", s + 1, words_of(step)),
                 "text");
    if (step.contains("why"))
      picture.text({corner.x, corner.y + size + 33}, step["why"].get<std::string>(), "note");
  }
  double y = picture.height() + 30;
  picture.text({0, y}, "polygon: triangle; its corners x, y, z in the window", "note");
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    y += row_height;
    std::string words = fmt::format("{}: {}", i, polygons[i]["triangle"].dump());
    if (polygons[i].contains("part_of")) words += ", part of " + polygons[i]["part_of"].dump();
    picture.text({0, y}, words, "text");
    Place end{130, y};
    for (const Json& point : polygons[i]["corners"]) {
      picture.text(end, "(", "number");
      end = picture.values({end.x + width_of("("), y}, point, "corner");
      picture.text(end, ")", "number");
      end.x += width_of(") ");
    }
  }
  return picture;
}

}  // namespace

std::vector<Picture> draw_trace(const Json& trace, std::uint32_t width, std::uint32_t height) {
  std::vector<Picture> pictures{draw_window(trace, width, height)};
  if (trace.contains("fragment_list")) pictures.push_back(draw_fragments(trace));
  if (trace.contains("output_merger")) pictures.push_back(draw_merger(trace));
  if (trace.contains("painter")) pictures.push_back(draw_painter(trace["painter"]));
  return pictures;
}

}  // namespace fathom::app::drawing
