#include "apps/textbook/pipeline/trace_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "apps/shell/json_answer.h"
#include "fathom/text/counted.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;
using pipeline::TriangleTrace;

const char* name_of(pipeline::Facing facing) {
  constexpr const char* names[] = {"front", "back", "edge on"};
  return names[static_cast<std::size_t>(facing)];
}

Json to_json(const TriangleTrace& t) {
  Json corners = Json::array(), polygon = Json::array();
  for (const auto& c : t.corners)
    corners.push_back({{"mesh", c.mesh}, {"world", c.world}, {"eye", c.eye}, {"clip", c.clip}});
  for (const auto& c : t.polygon)
    polygon.push_back(
        {{"clip", c.clip}, {"ndc", c.ndc}, {"window", c.window}, {"snapped", c.snapped}});
  Json answer{
      {"near", t.near}, {"far", t.far}, {"vertex_transform", corners}, {"clipping", polygon}};
  answer["facing"] = {{"world", name_of(t.in_world)}};
  if (!t.polygon.empty()) {
    answer["facing"]["ndc"] = name_of(t.in_ndc);
    answer["facing"]["window"] = name_of(t.in_window);
    answer["culled"] = t.culled;
  }
  answer["fragments"] = t.fragments;
  if (t.sample) {
    answer["sample"] = {{"edges", t.sample->edges},
                        {"covered", t.sample->covered},
                        {"drawable", t.sample->drawable},
                        {"weights", t.sample->weights},
                        {"attribute_weights", t.sample->attribute_weights},
                        {"window_z", t.sample->window_z},
                        {"depth", t.sample->depth},
                        {"stored", t.sample->stored.bits}};
    if (t.sample->covered) {
      answer["sample"]["shading"] = {{"normals_turned", t.sample->turned},
                                     {"diffuse", t.sample->light.diffuse},
                                     {"specular", t.sample->light.specular},
                                     {"colour", t.sample->colour}};
    }
  }
  return answer;
}

}  // namespace

std::string as_json(const TriangleTrace& t) {
  return json_answer(to_json(t));
}

std::string as_text(const TriangleTrace& t) {
  constexpr const char* names = "ABC";
  std::string text =
      fmt::format("clip range: near {}, far {}\n\nvertex transform\n", t.near, t.far);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& c = t.corners[k];
    text += fmt::format("  {}  mesh   ({})\n     world  ({})\n     eye    ({})\n     clip   ({})\n",
                        names[k], fmt::join(c.mesh, ", "), fmt::join(c.world, ", "),
                        fmt::join(c.eye, ", "), fmt::join(c.clip, ", "));
  }
  if (t.polygon.empty()) return text + "\nclipping: nothing is left in the view volume\n";
  text += fmt::format(
      "\nclipping, division, viewport: {}; the window from its upper left corner, y down\n",
      text::counted(t.polygon.size(), "corner"));
  for (const auto& c : t.polygon)
    text += fmt::format("  clip     ({})\n  NDC      ({})\n  window   ({})\n  snapped  ({})\n\n",
                        fmt::join(c.clip, ", "), fmt::join(c.ndc, ", "), fmt::join(c.window, ", "),
                        fmt::join(c.snapped, ", "));
  text += fmt::format(
      "facing: {} by N.V in the world, {} by n_z in NDC, {} by the determinant in the window{}\n",
      name_of(t.in_world), name_of(t.in_ndc), name_of(t.in_window), t.culled ? ": culled" : "");
  text += fmt::format("scan conversion: {}\n", text::counted(t.fragments, "fragment"));
  if (!t.sample) return text;
  const auto& s = *t.sample;
  text += fmt::format("\nsample: {}\n  edge functions       {}\n  weights              {}\n",
                      !s.covered   ? "not covered"
                      : s.drawable ? "covered"
                                   : "covered, but outside the viewport or the scissor box",
                      fmt::join(s.edges, ", "), fmt::join(s.weights, ", "));
  text += fmt::format(
      "  attribute weights    {}\n  window depth         {}\n  depth along the view {}\n",
      fmt::join(s.attribute_weights, ", "), s.window_z, s.depth);
  if (!s.covered) return text;
  text += fmt::format("  stored               {:#x}\n", s.stored.bits);
  text += fmt::format(
      "  light                {} diffuse, {} specular{}\n  colour               {}\n",
      s.light.diffuse, s.light.specular,
      s.turned ? "; the normals are turned: the back is seen" : "", fmt::join(s.colour, ", "));
  return text;
}

}  // namespace fathom::app
