#include "validation/report/junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <sstream>

#include "validation/report/cause.h"
#include "validation/report/worst_pixels.h"
#include "validation/report/xml_text.h"

namespace fathom::validation {
namespace {

using attribution::PixelClass;

/// What is wrong with a test case: `element` is failure or error.
struct Complaint {
  const char* element;
  std::string type, message, details;
};

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name).set_value(xml_text(value).c_str());
}

constexpr std::size_t listed_pixels = 8;

std::string details_of(const ValidationCase& c) {
  std::string text;
  for (const attribution::Finding& f : c.attribution.findings) {
    text += fmt::format("{}: {} ({} pixels)\n", f.kind, f.text, f.pixels);
  }
  for (const std::size_t i : worst_pixels(c, listed_pixels)) {
    text += attribution::name_of(c.attribution.classes[i]) + " " + pixel_text(c, i) + "\n";
  }
  return text;
}

std::optional<Complaint> complaint_about(const ValidationCase& c, const ResultChange* change) {
  if (!c.is_done()) return Complaint{"error", "not drawn", cause_of(c), ""};
  if (!c.is_good()) {
    const auto& findings = c.attribution.findings;
    return Complaint{"failure", findings.empty() ? "unexplained" : findings.front().kind,
                     cause_of(c), details_of(c)};
  }
  if (change == nullptr) return std::nullopt;
  if (change->verdict == Verdict::incomparable) {
    return Complaint{"error", "not comparable", change->obstacle, ""};
  }
  if (change->verdict != Verdict::worse) return std::nullopt;
  std::string details;
  for (const std::string& clause : change->worse) details += clause + "\n";
  return Complaint{"failure", "worse", "worse than the baseline: " + change->worse.front(),
                   details};
}

void add_case(pugi::xml_node suite, const ValidationCase& c,
              const std::optional<Complaint>& complaint) {
  pugi::xml_node node = suite.append_child("testcase");
  set(node, "classname", "fathom.validate." + c.scene);
  set(node, "name", c.renderer + (c.variant.empty() ? "" : " " + c.variant));
  if (c.seconds) set(node, "time", fmt::format("{:.3f}", *c.seconds));
  pugi::xml_node properties = node.append_child("properties");
  const auto property = [&](const std::string& name, const std::string& value) {
    pugi::xml_node p = properties.append_child("property");
    set(p, "name", name);
    set(p, "value", value);
  };
  property("version", c.version);
  if (c.is_done()) {
    for (std::size_t k = 0; k < attribution::pixel_class_count; ++k) {
      property(attribution::name_of(static_cast<PixelClass>(k)) + " pixels",
               std::to_string(c.attribution.counts[k]));
    }
    property("median relative bound", fmt::format("{:.3g}", c.attribution.median_relative_width));
    property("greatest relative error",
             fmt::format("{:.3g}", c.attribution.errors.greatest_relative));
  }
  if (!complaint) return;
  pugi::xml_node told = node.append_child(complaint->element);
  set(told, "message", complaint->message);
  set(told, "type", complaint->type);
  if (!complaint->details.empty()) {
    told.append_child(pugi::node_pcdata).set_value(xml_text(complaint->details).c_str());
  }
}

/// Sums of a suite, or of all.
struct Totals {
  std::size_t tests = 0, failures = 0, errors = 0;
  double seconds = 0;

  void add(const ValidationCase& c, const std::optional<Complaint>& complaint) {
    ++tests;
    if (complaint) ++(std::string(complaint->element) == "error" ? errors : failures);
    seconds += c.seconds.value_or(0);
  }
  void write_to(pugi::xml_node node) const {
    set(node, "tests", std::to_string(tests));
    set(node, "failures", std::to_string(failures));
    set(node, "errors", std::to_string(errors));
    if (seconds > 0) set(node, "time", fmt::format("{:.3f}", seconds));
  }
};

}  // namespace

std::string to_junit(const std::vector<ValidationCase>& cases, const Comparison* comparison) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  set(declaration, "encoding", "UTF-8");
  pugi::xml_node all = document.append_child("testsuites");
  set(all, "name", "fathom validate");
  Totals total;
  std::map<std::string, std::pair<pugi::xml_node, Totals>> suites;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const ValidationCase& c = cases[i];
    // A comparison begins with this run's results, in their order.
    const auto complaint =
        complaint_about(c, comparison != nullptr ? &comparison->changes[i] : nullptr);
    auto& [suite, sums] = suites[c.scene];
    if (!suite) {
      suite = all.append_child("testsuite");
      set(suite, "name", c.scene);
    }
    add_case(suite, c, complaint);
    sums.add(c, complaint);
    total.add(c, complaint);
  }
  for (auto& [scene, suite] : suites) suite.second.write_to(suite.first);
  total.write_to(all);
  std::ostringstream text;
  document.save(text, "  ", pugi::format_indent, pugi::encoding_utf8);
  return text.str();
}

}  // namespace fathom::validation
