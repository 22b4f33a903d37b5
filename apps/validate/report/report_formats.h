#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/validate/report/comparison.h"
#include "apps/validate/report/validation_case.h"
#include "fathom/image/rgb_image.h"

/// XML as it is written here: elements with attributes and either a text or elements.
namespace fathom::validation {

struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> elements;
  std::string text;
};

/// A text as it can stand in an attribute or between tags, so that a reader gets it back.
/// Characters that XML 1.0 cannot hold, and what could have effects on a terminal, become '?' or
/// U+FFFD.
/// Source   Extensible Markup Language 1.0, productions 2 (Char), 10 (AttValue), 14 (CharData) and
///          section 3.3.3, by which a line feed in an attribute is read as a space unless it is
///          escaped; fathom/text/printable.h.
std::string xml_text(std::string_view text);

/// An element in a line of its own, those within it below it, indented.
std::string to_xml(const XmlElement& element, int depth = 0);

// The forms in which `fathom validate` writes its results.

/// Each form lists at most so many of a comparison's worst pixels.
inline constexpr std::size_t listed_pixels = 8;

/// report.json, explained in docs/validation.md: {"fathom": version, "format": report_format,
/// "verdict": verdict_of(cases), "results": [ … ]}, one result for each case. Ends with a newline.
std::string to_json(const std::vector<ValidationCase>& cases);

/// report.html: a page that needs no other file. It contains report.json and every map, compressed:
/// exact depths, the renderers' depths, classes, triangle numbers.
std::string to_html(const std::vector<ValidationCase>& cases);

/// comparison.html: a page that needs no other file, with what changed between two runs, and links
/// report.html beside it.
std::string to_html(const Comparison& comparison);

/// A JUnit XML file for CI services: a test suite for each scene, and a test case for each renderer
/// and variant, with the number of pixels of each class as properties and with its time if it was
/// measured. A result with unexplained pixels or findings is a `failure` (message: verdict_of()),
/// unless the comparison contains it and it is no worse; so is a result that got worse. A map that
/// was not drawn, or a result that cannot be compared, is an `error`.
/// Needs    the comparison, if there is one, to be of the same cases.
std::string to_junit(const std::vector<ValidationCase>& cases, const Comparison* comparison);

/// The files with the pictures of a result.
struct PictureFiles {
  std::filesystem::path classes, differences;
};

/// Lines that CTest reads from the output of a test and passes on to CDash: the cause of a failure
/// as details; the pixels of each class, the bound and the greatest error as measurements; the
/// pictures as files.
/// Needs    a map.
/// Source   ctest(1), "Additional Test Measurements".
std::string to_ctest_lines(const ValidationCase& validated, const std::string& cause,
                           const PictureFiles& pictures);

// The pictures of report.html as files, with legends. Small maps are enlarged by a whole factor.
// Pictures of very large maps show every k-th pixel.

/// The names of the pictures in the folder of a report.
inline constexpr const char *class_picture_name = "classes.png",
                            *difference_picture_name = "differences.png";

/// The class of each pixel, in the colours of the page, with how many there are.
/// Needs    a map.
/// Fails    OutputError if the font is missing.
RgbImage class_picture(const ValidationCase& validated);

/// Relative differences of depth, other minus exact: blue is nearer, orange farther. The scale ends
/// where 2 % of the differences lie beyond it. Needs and fails likewise.
RgbImage difference_picture(const ValidationCase& validated);

}  // namespace fathom::validation
