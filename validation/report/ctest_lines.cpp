#include "validation/report/ctest_lines.h"

#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>

#include "validation/report/xml_text.h"

namespace fathom::validation {
namespace {

/// An element in a line of its own: CTest looks for them one by one, each as a document.
std::string element(const char* name, const std::string& type, const std::string& title,
                    const std::string& value) {
  pugi::xml_document document;
  pugi::xml_node node = document.append_child(name);
  if (!type.empty()) node.append_attribute("type").set_value(type.c_str());
  if (!title.empty()) node.append_attribute("name").set_value(title.c_str());
  node.append_child(pugi::node_pcdata).set_value(xml_text(value).c_str());
  std::ostringstream text;
  node.print(text, "", pugi::format_raw, pugi::encoding_utf8);
  return text.str() + "\n";
}

std::string number(const std::string& title, const std::string& value) {
  return element("CTestMeasurement", "numeric/double", title, value);
}

std::string picture(const std::string& title, const std::filesystem::path& file) {
  return element("CTestMeasurementFile", "image/png", title, std::filesystem::absolute(file));
}

}  // namespace

std::string to_ctest_lines(const ValidationCase& c, const std::string& cause,
                           const PictureFiles& pictures) {
  const attribution::Attribution& a = c.attribution;
  std::string text;
  if (!cause.empty()) text += element("CTestDetails", "", "", cause);
  for (std::size_t k = 0; k < attribution::pixel_class_count; ++k) {
    text += number(attribution::name_of(static_cast<attribution::PixelClass>(k)) + " pixels",
                   std::to_string(a.counts[k]));
  }
  text += number("median relative bound", fmt::format("{:.6g}", a.median_relative_width));
  text += number("greatest relative error", fmt::format("{:.6g}", a.errors.greatest_relative));
  text += number("greatest error", fmt::format("{:.6g}", a.errors.greatest));
  return text + picture("Classes of pixels", pictures.classes) +
         picture("Differences of depth", pictures.differences);
}

}  // namespace fathom::validation
