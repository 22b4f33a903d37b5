#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "apps/validate/report/report_formats.h"
#include "apps/validate/report/validation_case.h"
#include "fathom/attribution/attribution.h"
#include "fathom/text/printable.h"

namespace fathom::validation {
namespace {

/// U+FFFE and U+FFFF are UTF-8 and no characters.
void replace_noncharacters(std::string& text) {
  for (const char* no_character : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {
    for (std::size_t at = 0; (at = text.find(no_character, at)) != std::string::npos; at += 3) {
      text.replace(at, 3, "\xEF\xBF\xBD");
    }
  }
}

std::string escaped(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\t':
      return "&#9;";
    case '\n':
      return "&#10;";
    default:
      return {c};
  }
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string possible = text::printable_lines(text), result;
  replace_noncharacters(possible);
  for (const char c : possible) result += escaped(c);
  return result;
}

std::string to_xml(const XmlElement& element, int depth) {
  const std::string indent(2 * static_cast<std::size_t>(depth), ' ');
  std::string xml = indent + "<" + element.name;
  for (const auto& [name, value] : element.attributes) {
    xml += " " + name + "=\"" + xml_text(value) + "\"";
  }
  if (element.elements.empty() && element.text.empty()) return xml + "/>\n";
  xml += ">" + xml_text(element.text);
  if (!element.elements.empty()) {
    xml += "\n";
    for (const XmlElement& inner : element.elements) xml += to_xml(inner, depth + 1);
    xml += indent;
  }
  return xml + "</" + element.name + ">\n";
}

namespace {

using attribution::PixelClass;

/// What is wrong with a test case: `element` is failure or error.
struct Complaint {
  std::string element, type, message, details;
};

std::string details_of(const ValidationCase& c) {
  std::string text;
  for (const attribution::Finding& f : c.attribution.findings) {
    text += finding_line(f) + "\n";
  }
  for (const std::size_t i :
       attribution::worst_pixels(*c.truth, c.other, c.attribution, listed_pixels)) {
    text += attribution::name_of(c.attribution.classes[i]) + " " + pixel_text(c, i) + "\n";
  }
  return text;
}

std::optional<Complaint> complaint_about(const ValidationCase& c, const ResultChange* change) {
  if (!c.is_done()) return Complaint{"error", "not drawn", cause_of(c), ""};
  // Without a baseline, every result is new.
  const Verdict verdict = change != nullptr ? change->verdict : Verdict::appeared;
  if (verdict == Verdict::incomparable) {
    return Complaint{"error", "not comparable", change->obstacle, ""};
  }
  if (!c.is_good() && (verdict == Verdict::appeared || verdict == Verdict::worse)) {
    const auto& findings = c.attribution.findings;
    return Complaint{"failure", findings.empty() ? "unexplained" : findings.front().kind,
                     verdict_of(c), details_of(c)};
  }
  if (verdict != Verdict::worse) return std::nullopt;
  std::string details;
  for (const std::string& clause : change->worse) details += clause + "\n";
  return Complaint{"failure", "worse", "worse than the baseline: " + change->worse.front(),
                   details};
}

XmlElement properties_of(const ValidationCase& c) {
  XmlElement properties{.name = "properties"};
  const auto add = [&](const std::string& name, const std::string& value) {
    properties.elements.push_back({"property", {{"name", name}, {"value", value}}, {}, ""});
  };
  if (!c.version.empty()) add("version", c.version);
  if (!c.file.empty()) add("map", c.file);
  if (!c.is_done()) return properties;
  const attribution::Attribution& a = c.attribution;
  for (std::size_t k = 0; k < attribution::pixel_class_count; ++k) {
    const auto pixel_class = static_cast<PixelClass>(k);
    add(attribution::name_of(pixel_class) + " pixels",
        pixel_class == PixelClass::z_fight ? z_fight_count_text(c) : std::to_string(a.counts[k]));
  }
  if (c.predicted_fights) {
    add("z-fight pixels by the format alone", std::to_string(*c.predicted_fights));
  }
  add("median relative bound", fmt::format("{:.3g}", a.sharpness.median_relative_width));
  add("greatest relative error", fmt::format("{:.3g}", a.errors.greatest_relative));
  return properties;
}

std::string seconds_text(double seconds) {
  return fmt::format("{:.3f}", seconds);
}

XmlElement test_case(const ValidationCase& c, const std::optional<Complaint>& complaint) {
  XmlElement element{
      .name = "testcase",
      .attributes = {{"classname", "fathom.validate." + c.scene},
                     {"name", c.renderer + (c.variant.empty() ? "" : " ") + c.variant}}};
  if (c.seconds) element.attributes.emplace_back("time", seconds_text(*c.seconds));
  element.elements.push_back(properties_of(c));
  if (complaint) {
    element.elements.push_back({complaint->element,
                                {{"message", complaint->message}, {"type", complaint->type}},
                                {},
                                complaint->details});
  }
  return element;
}

/// The test cases of a scene, or all scenes, and their sums.
struct Suite {
  XmlElement element;
  std::size_t tests = 0, failures = 0, errors = 0;
  double seconds = 0;

  void count(const ValidationCase& c, const std::optional<Complaint>& complaint) {
    ++tests;
    if (complaint) ++(complaint->element == "error" ? errors : failures);
    seconds += c.seconds.value_or(0);
  }
  [[nodiscard]] XmlElement finished() const {
    XmlElement done = element;
    done.attributes.insert(done.attributes.end(), {{"tests", std::to_string(tests)},
                                                   {"failures", std::to_string(failures)},
                                                   {"errors", std::to_string(errors)}});
    if (seconds > 0) done.attributes.emplace_back("time", seconds_text(seconds));
    return done;
  }
};

Suite suite_called(const std::string& element, const std::string& name) {
  return {.element = {.name = element, .attributes = {{"name", name}}}};
}

Suite& suite_of(std::vector<Suite>& suites, const std::string& scene) {
  for (Suite& suite : suites) {
    if (suite.element.attributes.front().second == scene) return suite;
  }
  return suites.emplace_back(suite_called("testsuite", scene));
}

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

std::string to_junit(const std::vector<ValidationCase>& cases, const Comparison* comparison) {
  Suite all = suite_called("testsuites", "fathom validate");
  std::vector<Suite> suites;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const ValidationCase& c = cases[i];
    // A comparison begins with this run's results, in their order.
    const auto complaint =
        complaint_about(c, comparison != nullptr ? &comparison->changes[i] : nullptr);
    Suite& suite = suite_of(suites, c.scene);
    suite.element.elements.push_back(test_case(c, complaint));
    suite.count(c, complaint);
    all.count(c, complaint);
  }
  for (const Suite& suite : suites) all.element.elements.push_back(suite.finished());
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + to_xml(all.finished());
}

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
