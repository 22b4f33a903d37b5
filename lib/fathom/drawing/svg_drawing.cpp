#include "fathom/drawing/drawn_numbers.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/printable.h"

namespace fathom {
using namespace drawing;

namespace {

std::string xml_name(const std::string& name) {
  std::string escaped;
  for (const char c : text::printable(name)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

/// One path element for all, in lines of a file that can be compared.
void append_paths(std::string& text, const std::vector<DrawnPath>& paths) {
  if (paths.empty()) return;
  text += "<path d=\"";
  for (const DrawnPath& path : paths) {
    text += 'M';
    for (const DrawnPoint& point : path) append_point(text, point);
    text.back() = '\n';
  }
  text.back() = '"';
  text += "/>\n";
}

}  // namespace

std::string svg_of(const Drawing& drawing, const DrawingStyle& style) {
  const StandardArithmetic standard;
  require_valid(style);
  const std::string width = std::to_string(drawing.width), height = std::to_string(drawing.height);
  std::string text = R"(<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" version="1.1"
     xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width=")" +
                     width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height +
                     "\">\n<g fill=\"none\" stroke=\"black\" stroke-linecap=\"round\" "
                     "stroke-linejoin=\"round\" stroke-width=\"";
  append_number(text, style.stroke);
  text.back() = '"';
  text += ">\n";
  for (std::size_t k = 0; k < drawing.layers.size(); ++k) {
    const DrawingLayer& layer = drawing.layers[k];
    const std::string name = xml_name(layer.name);
    text += "<g id=\"object-" + std::to_string(k) +
            "\" inkscape:groupmode=\"layer\" inkscape:label=\"" + name + "\">\n<title>" + name +
            "</title>\n";
    append_paths(text, layer.paths);
    text += "</g>\n";
  }
  return text + "</g>\n</svg>\n";
}

}  // namespace fathom
