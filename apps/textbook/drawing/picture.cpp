#include "apps/textbook/drawing/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/text/printable.h"

namespace fathom::app::drawing {
namespace {

constexpr double margin = 20;

/// The colours of both themes once, as variables; kinds use nothing else.
constexpr const char* style =
    R"(
svg.fathom-steps { --ink: #1b1f24; --faint: #6a727c; --paper: #ffffff; --soft: #e8edf2; )"
    R"(--a: #c62828; --b: #1565c0;
  --c: #1b7f3b; --d: #9a6700; font: 13px system-ui, "DejaVu Sans", sans-serif; }
@media (prefers-color-scheme: dark) {
  svg.fathom-steps { --ink: #e6e8eb; --faint: #98a1ab; --paper: #16181b; --soft: #2a3038; )"
    R"(--a: #ff7b72; --b: #79b8ff;
    --c: #56d364; --d: #e3b341; }
}
.paper { fill: var(--paper); }
text { paint-order: stroke; stroke: var(--paper); stroke-width: 3px; )"
    R"(stroke-linejoin: round; }
.text { fill: var(--ink); } )"
    R"(.title { fill: var(--ink); font-weight: 600; font-size: 15px; } .note { fill: var(--faint); }
.number { fill: var(--ink); } )"
    R"(.number, .small { font-family: ui-monospace, "DejaVu Sans Mono", monospace; }
.number { font-size: 13px; } .small { fill: var(--ink); font-size: 11px; } )"
    R"(.label { fill: var(--ink); font-size: 13px; }
.ink, .thin, .a, .b, .c, .d { fill: none; stroke-width: 1.5; } )"
    R"(.ink { stroke: var(--ink); } .thin { stroke: var(--faint); stroke-width: 1; }
.a { stroke: var(--a); stroke-width: 2.2; } .b { stroke: var(--b); stroke-width: 2.2; } )"
    R"(.c { stroke: var(--c); stroke-width: 2.2; }
.d { stroke: var(--d); stroke-width: 2.2; }
.soft { fill: var(--soft); stroke: none; } )"
    R"(.cell { fill: none; stroke: var(--faint); stroke-opacity: 0.35; }
.fill-a, .fill-b, .fill-c, .fill-d { fill-opacity: 0.22; stroke: none; } )"
    R"(.fill-a { fill: var(--a); } .fill-b { fill: var(--b); }
.fill-c { fill: var(--c); } .fill-d { fill: var(--d); }
.band-a, .band-b { fill-opacity: 0.09; stroke: none; } .band-a { fill: var(--a); } )"
    R"(.band-b { fill: var(--b); }
.dot { fill: var(--ink); } .dot-a { fill: var(--a); } .dot-b { fill: var(--b); } )"
    R"(.dot-c { fill: var(--c); } .dot-d { fill: var(--d); }
.swatch { stroke: var(--faint); }
.text-a { fill: var(--a); font-weight: 600; } )"
    R"(.text-b { fill: var(--b); font-weight: 600; } .text-c { fill: var(--c); font-weight: 600; }
.text-d { fill: var(--d); font-weight: 600; }
)";

/// A coordinate of the page, to a hundredth of a pixel.
std::string page(double x) {
  std::string text = fmt::format("{:.2f}", x);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string escaped(std::string_view words) {
  std::string text;
  for (const char c : text::printable(std::string(words))) {
    if (c == '&')
      text += "&amp;";
    else if (c == '<')
      text += "&lt;";
    else if (c == '>')
      text += "&gt;";
    else if (c == '"')
      text += "&quot;";
    else
      text += c;
  }
  return text;
}

bool overlap(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

bool contains(const Box& outer, const Box& inner) {
  return outer.left <= inner.left && outer.top <= inner.top && outer.right >= inner.right &&
         outer.bottom >= inner.bottom;
}

std::size_t characters_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

}  // namespace

double number_of(const Json& number) {
  if (!number.is_string()) return number.get<double>();
  return clipping::to_binary64(clipping::Rational(number.get<std::string>()));
}

std::string shown(const Json& number) {
  constexpr std::size_t longest = 8;
  std::string text = number.is_string() ? number.get<std::string>() : number.dump();
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text.size() <= longest ? text : fmt::format("{:.5g}", number_of(number));
}

double width_of(std::string_view text, double size) {
  return 0.62 * size * static_cast<double>(characters_of(text));
}

Place place_of(const Json& point) {
  return {number_of(point[0]), number_of(point[1])};
}

std::vector<Place> places_of(const Json& points) {
  std::vector<Place> places;
  for (const Json& point : points) places.push_back(place_of(point));
  return places;
}

void Picture::reach(double x, double y) {
  width_ = std::max(width_, x);
  height_ = std::max(height_, y);
}

void Picture::line(Place a, Place b, std::string_view kind, bool dashed) {
  elements_ +=
      fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" class=\"{}\"{}/>\n", page(a.x),
                  page(a.y), page(b.x), page(b.y), kind, dashed ? " stroke-dasharray=\"4 4\"" : "");
  reach(std::max(a.x, b.x), std::max(a.y, b.y));
}

void Picture::arrow(Place a, Place b, std::string_view kind) {
  line(a, b, kind);
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (length < 1) return;
  // The head stands in the middle, so that it is seen where several arrows end in one point.
  const double dx = (b.x - a.x) / length, dy = (b.y - a.y) / length;
  const Place tip{(a.x + b.x) / 2 + 4 * dx, (a.y + b.y) / 2 + 4 * dy};
  for (const double side : {1.0, -1.0})
    line(tip, {tip.x - 8 * dx + side * 4 * dy, tip.y - 8 * dy - side * 4 * dx}, kind);
}

void Picture::polygon(const std::vector<Place>& corners, std::string_view kind) {
  std::string points;
  for (const Place& p : corners) {
    points += fmt::format("{}{},{}", points.empty() ? "" : " ", page(p.x), page(p.y));
    reach(p.x, p.y);
  }
  elements_ += fmt::format("<polygon points=\"{}\" class=\"{}\"/>\n", points, kind);
}

void Picture::rect(const Box& box, std::string_view kind) {
  elements_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" class=\"{}\"/>\n",
                           page(box.left), page(box.top), page(box.right - box.left),
                           page(box.bottom - box.top), kind);
  reach(box.right, box.bottom);
}

void Picture::dot(Place at, std::string_view kind, double radius) {
  elements_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" class=\"{}\"/>\n", page(at.x),
                           page(at.y), page(radius), kind);
  reach(at.x + radius, at.y + radius);
}

void Picture::swatch(const Box& box, const Json& colour) {
  const auto percent = [&](std::size_t k) {
    return page(100 * std::clamp(colour[k].get<double>(), 0.0, 1.0));
  };
  elements_ += fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" class=\"swatch\" fill=\"rgb({}%, {}%, "
      "{}%)\" "
      "data-value=\"{}\"/>\n",
      page(box.left), page(box.top), page(box.right - box.left), page(box.bottom - box.top),
      percent(0), percent(1), percent(2), colour.dump());
  reach(box.right, box.bottom);
}

void Picture::text(Place at, std::string_view words, std::string_view kind,
                   std::string_view anchor) {
  elements_ += fmt::format("<text x=\"{}\" y=\"{}\" class=\"{}\" text-anchor=\"{}\">{}</text>\n",
                           page(at.x), page(at.y), kind, anchor, escaped(words));
  const double width = width_of(words, kind == "title" ? 15 : 13);
  reach(at.x + (anchor == "start" ? width : anchor == "middle" ? width / 2 : 0), at.y + 4);
}

void Picture::value(Place at, const Json& number, std::string_view of, std::string_view kind,
                    std::string_view anchor) {
  const std::string words = shown(number);
  elements_ += fmt::format(
      "<text x=\"{}\" y=\"{}\" class=\"{}\" text-anchor=\"{}\" data-of=\"{}\" "
      "data-value=\"{}\">{}</text>\n",
      page(at.x), page(at.y), kind, anchor, of, escaped(number.dump()), words);
  reach(at.x + (anchor == "start" ? width_of(words) : 0), at.y + 4);
}

Place Picture::values(Place at, const Json& numbers, std::string_view of) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    value(at, numbers[i], of);
    at.x += width_of(shown(numbers[i]));
    if (i + 1 < numbers.size()) {
      text(at, ",", "number");
      at.x += width_of(", ");
    }
  }
  return at;
}

void Picture::label(Place point, std::string_view words, const Box& bounds) {
  const double width = width_of(words), height = 14, gap = 4;
  constexpr double directions[][2] = {{1, -1}, {-1, -1}, {1, 1}, {-1, 1},
                                      {0, -1}, {1, 0},   {0, 1}, {-1, 0}};
  for (const double radius : {6.0, 18.0, 32.0, 48.0, 68.0, 90.0}) {
    for (const auto& [dx, dy] : directions) {
      const double x = point.x + dx * radius + (dx < 0 ? -width : dx > 0 ? 0 : -width / 2);
      const double y = point.y + dy * radius + (dy < 0 ? -height : dy > 0 ? 0 : -height / 2);
      const Box box{x, y, x + width, y + height};
      if (!contains(bounds, box)) continue;
      // Side by side, two labels would read as one.
      const Box clear{box.left - gap, box.top, box.right + gap, box.bottom};
      if (std::any_of(taken_.begin(), taken_.end(),
                      [&](const Box& other) { return overlap(clear, other); }))
        continue;
      if (radius > 20) line(point, {x + width / 2, y + height / 2}, "thin");
      taken_.push_back(box);
      text({x, y + height - 3}, words, "label");
      return;
    }
  }
}

std::string document(const std::string& title, const std::vector<Picture>& pictures) {
  double width = width_of(title, 15), height = margin;
  std::string body;
  for (const Picture& picture : pictures) {
    body += fmt::format("<g transform=\"translate({}, {})\">\n{}</g>\n", page(margin), page(height),
                        picture.elements());
    width = std::max(width, picture.width());
    height += picture.height() + margin;
  }
  width += 2 * margin;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"fathom-steps\" width=\"{0}\" "
      "height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" role=\"img\" "
      "aria-label=\"{2}\">\n<title>{2}</title>\n<style>{3}</style>\n"
      "<rect width=\"{0}\" height=\"{1}\" class=\"paper\"/>\n{4}</svg>\n",
      page(std::ceil(width)), page(std::ceil(height)), escaped(title), style, body);
}

View::View(const std::vector<Place>& points, Place corner, double width, double height, bool y_down)
    : y_down_(y_down) {
  least_ = greatest_ = points.empty() ? Place{} : points[0];
  for (const Place& p : points) {
    least_ = {std::min(least_.x, p.x), std::min(least_.y, p.y)};
    greatest_ = {std::max(greatest_.x, p.x), std::max(greatest_.y, p.y)};
  }
  // A tenth about it, so that labels have room.
  const double across = std::max(greatest_.x - least_.x, 1e-300),
               down = std::max(greatest_.y - least_.y, 1e-300);
  scale_ = 0.8 * std::min(width / across, height / down);
  const double rest_x = (width / scale_ - (greatest_.x - least_.x)) / 2,
               rest_y = (height / scale_ - (greatest_.y - least_.y)) / 2;
  least_ = {least_.x - rest_x, least_.y - rest_y};
  greatest_ = {greatest_.x + rest_x, greatest_.y + rest_y};
  left_ = corner.x;
  top_ = corner.y;
  box_ = {corner.x, corner.y, corner.x + width, corner.y + height};
}

std::vector<Place> View::operator()(const std::vector<Place>& places) const {
  std::vector<Place> result;
  result.reserve(places.size());
  for (const Place& p : places) result.push_back((*this)(p));
  return result;
}

}  // namespace fathom::app::drawing
