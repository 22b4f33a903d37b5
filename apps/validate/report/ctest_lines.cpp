#include "apps/validate/report/ctest_lines.h"

#include <fmt/format.h>

#include "apps/validate/report/xml.h"

namespace fathom::validation {
namespace {

std::string number(const std::string& title, const std::string& value) {
  return to_xml({"CTestMeasurement", {{"type", "numeric/double"}, {"name", title}}, {}, value});
}

std::string picture(const std::string& title, const std::filesystem::path& file) {
  return to_xml({"CTestMeasurementFile",
                 {{"type", "image/png"}, {"name", title}},
                 {},
                 std::filesystem::absolute(file)});
}

}  // namespace

std::string to_ctest_lines(const ValidationCase& c, const std::string& cause,
                           const PictureFiles& pictures) {
  const attribution::Attribution& a = c.attribution;
  std::string text;
  if (!cause.empty()) text += to_xml({"CTestDetails", {}, {}, cause});
  for (std::size_t k = 0; k < attribution::pixel_class_count; ++k) {
    text += number(attribution::name_of(static_cast<attribution::PixelClass>(k)) + " pixels",
                   std::to_string(a.counts[k]));
  }
  text += number("median relative bound", fmt::format("{:.6g}", a.sharpness.median_relative_width));
  text += number("greatest relative error", fmt::format("{:.6g}", a.errors.greatest_relative));
  text += number("greatest error", fmt::format("{:.6g}", a.errors.greatest));
  return text + picture("Classes of pixels", pictures.classes) +
         picture("Differences of depth", pictures.differences);
}

}  // namespace fathom::validation
