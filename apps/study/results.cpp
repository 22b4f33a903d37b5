#include "apps/study/results.h"

#include <iterator>
#include <optional>

namespace fathom::studies {

namespace {

std::string command_of(const std::string& study, const StudyOptions& options) {
  std::string command = "fathom study " + study;
  if (options.scene) command += " --scene " + options.scene->name;
  const auto add = [&](const char* name, const auto& value) {
    if (value) command += std::string(" --") + name + " " + text_of(*value);
  };
  add("near", options.near);
  add("far", options.far);
  add("separation", options.separation);
  add("samples", options.samples);
  return command;
}

}  // namespace

Results::Results(const std::string& study, std::string_view page, const StudyOptions& options)
    : summary_{{"study", Cell(study)}},
      page_(page),
      command_(command_of(study, options) + " --out DIR"),
      plots_(options.plots) {
  page_.add_value("study", command_);
}

void Results::figure(const std::string& key, const Cell& value, const char* page_format) {
  summary_.emplace_back(key, value);
  quote(key, value, page_format);
}

void Results::quote(const std::string& name, const Cell& value, const char* page_format) {
  page_.add_value(name, text_of(value, page_format));
}

void Results::table(const Table& table, const Places& places) {
  if (!places.csv.empty()) {
    files_.push_back({places.csv + ".csv", csv_of(table), std::make_shared<const Table>(table)});
  }
  if (!places.json.empty()) summary_.emplace_back(places.json, table);
  if (!places.page.empty()) page_.add_table(places.page, table);
}

void Results::plot(const Plot& plot) {
  this->plot(plot.name, [&] { return draw(plot); });
}

void Results::plot(const BarChart& chart) {
  this->plot(chart.name, [&] { return draw(chart); });
}

void Results::plot(const HeatMap& map) {
  this->plot(map.name, [&] { return draw(map); });
}

void Results::plot(const std::string& name, const std::function<std::vector<StudyFile>()>& draw) {
  std::vector<StudyFile> files;
  if (plots_) files = draw();
  page_.add_plot(name, !files.empty());
  std::move(files.begin(), files.end(), std::back_inserter(files_));
}

void Results::picture(StudyFile png, std::uint32_t width) {
  page_.add_picture(png.name.substr(0, png.name.rfind('.')), width);
  files_.push_back(std::move(png));
}

void Results::picture(StudyFile png, const std::string& command, std::uint32_t width) {
  quote("draw " + png.name.substr(0, png.name.rfind('.')), command);
  picture(std::move(png), width);
}

void Results::file(StudyFile file) {
  files_.push_back(std::move(file));
}

void Results::pictures(std::vector<StudyFile> pngs) {
  for (StudyFile& png : pngs) picture(std::move(png));
}

void Results::text(const std::string& name, const std::string& text) {
  page_.add_text(name, text);
}

std::string Results::commands() const {
  return "`" + command_ +
         "` makes this page with its tables, plots and pictures. In its folder, the "
         "command under a plot or a picture draws it again.";
}

std::vector<StudyFile> Results::files() const {
  std::vector<StudyFile> files = files_;
  files.push_back({"summary.json", json_of(summary_)});
  files.push_back({"index.html", page_.html("Commands", commands())});
  return files;
}

}  // namespace fathom::studies
