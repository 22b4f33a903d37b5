#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "fathom/drawing/drawing.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/printable.h"

namespace fathom {
namespace {

/// Appends the shortest decimal text without an exponent, which PDF does not read, that is read
/// back as the number, and a space.
template <class Real>
void append_number(std::string& text, Real number) {
  // The longest have all digits of the least binary64 number after the point.
  std::array<char, 400> digits{};
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed);
  text.append(digits.data(), end.ptr);
  text += ' ';
}

void append_point(std::string& text, const DrawnPoint& point) {
  append_number(text, point[0]);
  append_number(text, point[1]);
}

void require_valid(const DrawingStyle& style) {
  if (!std::isfinite(style.stroke) || style.stroke <= 0) {
    throw UsageError("the stroke: expected a width in pixels above 0");
  }
}

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

/// Source   ISO 32000-1:2008: 7.5 (structure), 8.4 to 8.5 (paths), 8.11 (optional content).

namespace {

/// A point is 1/72 inch. No side of a page has more (annex C).
constexpr double points_of_pixel = 0.75, most_points = 14400;

/// A text as UTF-16 in hexadecimal digits.
std::string pdf_text(const std::string& name) {
  std::string digits = "<FEFF";
  const auto add = [&](char32_t unit) {
    constexpr std::string_view hex = "0123456789ABCDEF";
    for (int shift = 12; shift >= 0; shift -= 4) digits += hex[unit >> shift & 15U];
  };
  const std::string valid = text::printable(name);
  for (std::string_view rest = valid; !rest.empty();) {
    const text::Utf8Character next = text::first_character(rest);
    rest.remove_prefix(next.size);
    constexpr char32_t first_pair = 0x10000;
    if (next.code < first_pair) {
      add(next.code);
    } else {
      add(0xD800 + ((next.code - first_pair) >> 10U));
      add(0xDC00 + ((next.code - first_pair) & 0x3FFU));
    }
  }
  return digits + ">";
}

/// Objects of a file, with their offsets.
class PdfFile {
 public:
  /// Objects are numbered from 1, in the order in which they are added.
  void add(const std::string& object) {
    offsets_.push_back(text_.size());
    text_ += std::to_string(offsets_.size()) + " 0 obj\n" + object + "\nendobj\n";
  }

  [[nodiscard]] std::string with_index() const {
    const std::string count = std::to_string(offsets_.size() + 1);
    std::string file = text_ + "xref\n0 " + count + "\n0000000000 65535 f \n";
    for (const std::size_t offset : offsets_) {
      const std::string digits = std::to_string(offset);
      file +=
          std::string(10 - std::min<std::size_t>(10, digits.size()), '0') + digits + " 00000 n \n";
    }
    return file + "trailer\n<< /Size " + count + " /Root 1 0 R >>\nstartxref\n" +
           std::to_string(text_.size()) + "\n%%EOF\n";
  }

 private:
  /// The bytes of the comment show that the file is not plain text.
  std::string text_ = "%PDF-1.5\n%\xE2\xE3\xCF\xD3\n";
  std::vector<std::size_t> offsets_;
};

/// The numbers of the objects before the objects of the layers.
constexpr std::size_t objects_before_layers = 4;

std::string reference(std::size_t layer) {
  return std::to_string(objects_before_layers + 1 + layer) + " 0 R ";
}

/// The page's y grows upwards.
std::string content_of(const Drawing& drawing, const DrawingStyle& style, double scale) {
  std::string text = "q ";
  for (const double number : {scale, 0.0, 0.0, -scale, 0.0, scale * drawing.height}) {
    append_number(text, number);
  }
  text += "cm 1 J 1 j ";
  append_number(text, style.stroke);
  text += "w\n";
  for (std::size_t k = 0; k < drawing.layers.size(); ++k) {
    text += "/OC /L" + std::to_string(k) + " BDC\n";
    for (const DrawnPath& path : drawing.layers[k].paths) {
      for (std::size_t i = 0; i < path.size(); ++i) {
        append_point(text, path[i]);
        text += i == 0 ? "m " : "l ";
      }
      text += "S\n";
    }
    text += "EMC\n";
  }
  return text + "Q";
}

}  // namespace

std::string pdf_of(const Drawing& drawing, const DrawingStyle& style) {
  const StandardArithmetic standard;
  require_valid(style);
  const double greatest = std::max(drawing.width, drawing.height);
  const double scale = std::min(points_of_pixel, most_points / greatest);
  std::string groups, names;
  for (std::size_t k = 0; k < drawing.layers.size(); ++k) {
    groups += reference(k);
    names += "/L" + std::to_string(k) + " " + reference(k);
  }
  std::string box = "0 0 ";
  append_number(box, scale * drawing.width);
  append_number(box, scale * drawing.height);
  const std::string content = content_of(drawing, style, scale);
  PdfFile file;
  file.add("<< /Type /Catalog /Pages 2 0 R /OCProperties << /OCGs [" + groups + "] /D << /Order [" +
           groups + "] /ON [" + groups + "] >> >> >>");
  file.add("<< /Type /Pages /Kids [3 0 R] /Count 1 >>");
  file.add("<< /Type /Page /Parent 2 0 R /MediaBox [" + box +
           "] /Contents 4 0 R /Resources << /Properties << " + names + ">> >> >>");
  file.add("<< /Length " + std::to_string(content.size()) + " >>\nstream\n" + content +
           "\nendstream");
  for (const DrawingLayer& layer : drawing.layers) {
    file.add("<< /Type /OCG /Name " + pdf_text(layer.name) + " >>");
  }
  return file.with_index();
}

}  // namespace fathom
