#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/textbook/pipeline/pipeline_report.h"
#include "apps/textbook/pipeline/stage_cases.h"
#include "fathom/text/counted.h"
#include "fathom/threads/interruption.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;
using pipeline::PrimitiveKind;
using pipeline::PrimitiveTrace;

const char* name_of(pipeline::Facing facing) {
  constexpr const char* names[] = {"front", "back", "edge on"};
  return names[static_cast<std::size_t>(facing)];
}

const char* name_of(PrimitiveKind kind) {
  constexpr const char* names[] = {"triangle", "line", "point"};
  return names[static_cast<std::size_t>(kind)];
}

const char* name_of_test(int test) {
  constexpr const char* names[] = {"x extents are disjoint", "y extents are disjoint",
                                   "P lies behind the plane of Q", "Q lies before the plane of P",
                                   "the projections do not overlap"};
  return names[static_cast<std::size_t>(test - 1)];
}

Json sample_json(const pipeline::SampleTrace& s) {
  Json sample{{"edges", s.edges},
              {"covered", s.covered},
              {"drawable", s.drawable},
              {"weights", s.weights},
              {"attribute_weights", s.attribute_weights},
              {"window_z", s.window_z},
              {"depth", s.depth},
              {"stored", s.stored.bits}};
  if (s.covered)
    sample["shading"] = {{"normals_turned", s.turned},
                         {"diffuse", s.light.diffuse},
                         {"specular", s.light.specular},
                         {"colour", s.colour}};
  return sample;
}

Json step_json(const pipeline::PainterStep& step) {
  using Kind = pipeline::PainterStep::Kind;
  switch (step.kind) {
    case Kind::z_disjoint:
      return {{"step", "before"}, {"P", step.P}, {"Q", step.Q}, {"why", "z extents are disjoint"}};
    case Kind::settled:
      return {{"step", "before"},
              {"P", step.P},
              {"Q", step.Q},
              {"test", step.test},
              {"why", name_of_test(step.test)}};
    case Kind::moved:
      return {{"step", "moved"}, {"P", step.P}, {"Q", step.Q}};
    case Kind::split:
      return {{"step", "split"}, {"P", step.P},           {"Q", step.Q},
              {"cut", step.cut}, {"behind", step.behind}, {"before", step.before}};
    case Kind::forced:
      return {{"step", "kept"}, {"P", step.P}, {"Q", step.Q}};
    default:
      return {{"step", "painted"}, {"P", step.P}};
  }
}

Json painter_json(const pipeline::PainterTrace& painter) {
  Json polygons = Json::array(), steps = Json::array();
  for (const auto& p : painter.polygons) {
    Json& polygon = polygons.emplace_back(Json{{"triangle", p.triangle}, {"corners", p.corners}});
    if (p.part_of) polygon["part_of"] = *p.part_of;
  }
  for (const auto& step : painter.steps) {
    check_interruption();
    steps.push_back(step_json(step));
  }
  return {{"polygons", polygons}, {"steps", steps}};
}

void put_facing(Json& answer, const PrimitiveTrace& t) {
  if (t.kind != PrimitiveKind::triangle) return;
  answer["facing"] = {{"world", name_of(t.in_world)}};
  if (t.polygon.empty()) return;
  answer["facing"]["ndc"] = name_of(t.in_ndc);
  answer["facing"]["window"] = name_of(t.in_window);
  answer["culled"] = t.culled;
}

/// "(0.5, 0.25)"
template <class List>
std::string in_parentheses(const List& list) {
  return fmt::format("({})", fmt::join(list, ", "));
}

std::string text_of(const pipeline::FragmentTrace& f, Storage storage) {
  return fmt::format("  {},{}  window depth {}  depth {}  stored {:#x} = {}  colour {}\n",
                     f.pixel.x, f.pixel.y, f.window_z, f.depth, f.stored.bits,
                     stored_number(storage, f.stored), in_parentheses(f.colour));
}

std::string text_of(const pipeline::SampleTrace& s) {
  std::string text =
      fmt::format("\nsample: {}\n  edge functions       {}\n  weights              {}\n",
                  !s.covered   ? "not covered"
                  : s.drawable ? "covered"
                               : "covered, but outside the viewport or the scissor box",
                  fmt::join(s.edges, ", "), fmt::join(s.weights, ", "));
  text += fmt::format(
      "  attribute weights    {}\n  window depth         {}\n  depth along the view {}\n",
      fmt::join(s.attribute_weights, ", "), s.window_z, s.depth);
  if (!s.covered) return text;
  text += fmt::format("  stored               {:#x}\n", s.stored.bits);
  return text + fmt::format(
                    "  light                {} diffuse, {} specular{}\n  colour               {}\n",
                    s.light.diffuse, s.light.specular,
                    s.turned ? "; the normals are turned: the back is seen" : "",
                    fmt::join(s.colour, ", "));
}

/// What a sample of the frame buffer holds.
std::string text_of(const pipeline::StoredSample& s, Storage storage) {
  const std::string drawn =
      s.id == no_surface ? std::string("background") : fmt::format("primitive {}", s.id);
  return fmt::format("{}, depth {} ({:#x}{}), colour {}", drawn, stored_number(storage, s.stored),
                     s.stored.bits, s.depth_written ? "" : ", cleared", in_parentheses(s.colour));
}

std::string text_of(const pipeline::MergeStep& step, const PrimitiveTrace& t) {
  std::string text = fmt::format(
      "  primitive {}{}\n    in the pixel  {}\n    fragment      depth {} ({:#x}), colour {}\n",
      step.fragment.number, step.fragment.number == t.number ? " (this one)" : "",
      text_of(step.before, t.storage), stored_number(t.storage, step.fragment.stored),
      step.fragment.stored.bits, in_parentheses(step.colour));
  text +=
      fmt::format("    depth test    {}: {}\n", depth_test_name(step), outcome_name(step.outcome));
  if (step.rules.alpha)
    text += fmt::format("    blend         {} of the fragment, {} of the pixel\n",
                        *step.rules.alpha, 1 - *step.rules.alpha);
  return text + fmt::format("    afterwards    {}\n", text_of(step.after, t.storage));
}

std::string painter_text(const pipeline::PainterTrace& painter) {
  using Kind = pipeline::PainterStep::Kind;
  std::string text = "\npainter's order\n";
  for (const auto& step : painter.steps) {
    const auto triangle = [&](std::size_t polygon) {
      return fmt::format("{} (triangle {})", polygon, painter.polygons[polygon].triangle);
    };
    if (step.kind == Kind::painted)
      text += fmt::format("  paint polygon {}\n", triangle(step.P));
    else if (step.kind == Kind::moved)
      text += fmt::format("  polygon {} first, before {}\n", triangle(step.Q), triangle(step.P));
    else if (step.kind == Kind::split)
      text += fmt::format("  split polygon {} into {} behind and {} before\n", triangle(step.cut),
                          step.behind, step.before);
    else if (step.kind == Kind::forced)
      text += fmt::format("  keep polygon {} before {}\n", triangle(step.P), triangle(step.Q));
    else
      text += fmt::format(
          "  polygon {} before {}: {}\n", triangle(step.P), triangle(step.Q),
          step.kind == Kind::settled ? name_of_test(step.test) : "z extents are disjoint");
  }
  return text;
}

std::string stages_text(const PrimitiveTrace& t) {
  constexpr const char* names = "ABC";
  std::string text = fmt::format("{} {}\nclip range: near {}, far {}\n\nvertex transform\n",
                                 name_of(t.kind), t.number, t.near, t.far);
  for (std::size_t k = 0; k < t.corners.size(); ++k) {
    const auto& c = t.corners[k];
    text += fmt::format("  {}  mesh   {}\n     world  {}\n     eye    {}\n     clip   {}\n",
                        names[k], in_parentheses(c.mesh), in_parentheses(c.world),
                        in_parentheses(c.eye), in_parentheses(c.clip));
  }
  if (t.polygon.empty()) return text + "\nclipping: nothing is left in the view volume\n";
  text += fmt::format(
      "\nclipping, division, viewport: {}; the window from its upper left corner, y down\n",
      text::counted(t.polygon.size(), "corner"));
  for (const auto& c : t.polygon)
    text += fmt::format("  clip     {}\n  NDC      {}\n  window   {}\n  snapped  {}\n\n",
                        in_parentheses(c.clip), in_parentheses(c.ndc), in_parentheses(c.window),
                        in_parentheses(c.snapped));
  if (t.kind == PrimitiveKind::triangle)
    text += fmt::format(
        "facing: {} by N.V in the world, {} by n_z in NDC, {} by the determinant in the window{}\n",
        name_of(t.in_world), name_of(t.in_ndc), name_of(t.in_window), t.culled ? ": culled" : "");
  text += fmt::format("scan conversion: {}\n", text::counted(t.fragments, "fragment"));
  for (const auto& fragment : t.fragment_list) text += text_of(fragment, t.storage);
  if (t.sample) text += text_of(*t.sample);
  return text;
}

}  // namespace

Json to_json(const PrimitiveTrace& t) {
  Json corners = Json::array(), polygon = Json::array();
  for (const auto& c : t.corners)
    corners.push_back({{"mesh", c.mesh}, {"world", c.world}, {"eye", c.eye}, {"clip", c.clip}});
  for (const auto& c : t.polygon)
    polygon.push_back(
        {{"clip", c.clip}, {"ndc", c.ndc}, {"window", c.window}, {"snapped", c.snapped}});
  Json answer{
      {"primitive", name_of(t.kind)}, {"number", t.number}, {"near", t.near}, {"far", t.far},
      {"vertex_transform", corners},  {"clipping", polygon}};
  put_facing(answer, t);
  answer["fragments"] = t.fragments;
  for (const auto& f : t.fragment_list) {
    check_interruption();
    answer["fragment_list"].push_back({{"pixel", {f.pixel.x, f.pixel.y}},
                                       {"window_z", f.window_z},
                                       {"depth", f.depth},
                                       {"stored", stored_json(t.storage, f.stored)},
                                       {"colour", f.colour}});
  }
  if (t.sample) answer["sample"] = sample_json(*t.sample);
  for (const auto& step : t.merger) answer["output_merger"].push_back(merge_json(step, t.storage));
  if (!t.painter.polygons.empty()) answer["painter"] = painter_json(t.painter);
  return answer;
}

std::string as_text(const PrimitiveTrace& t) {
  std::string text = stages_text(t);
  if (!t.merger.empty()) {
    text += "\noutput merger: the fragments at the pixel, in drawing order\n";
    for (const auto& step : t.merger) text += text_of(step, t);
  }
  if (!t.painter.steps.empty()) text += painter_text(t.painter);
  return text;
}

}  // namespace fathom::app
