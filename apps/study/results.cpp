#include "apps/study/results.h"

#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

namespace fathom::studies {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Cell& cell) {
  return std::visit(
      [](const auto& value) -> Json {
        if constexpr (std::is_same_v<decltype(value), const std::monostate&>) {
          return nullptr;
        } else {
          return value;  // numbers that are not finite are written as null
        }
      },
      cell.value);
}

/// The place in an object that a key names: see Column::json.
Json& place_in(Json& object, const std::string& key) {
  if (key.ends_with("[]")) return object[key.substr(0, key.size() - 2)].emplace_back(nullptr);
  const std::size_t point = key.find('.');
  if (point == std::string::npos) return object[key];
  return object[key.substr(0, point)][key.substr(point + 1)];
}

Json json_of(const Table& table) {
  Json list = Json::array();
  for (const std::vector<Cell>& row : table.rows()) {
    Json object = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string& key = table.columns()[i].json_key;
      if (!key.empty()) place_in(object, key) = json_of(row[i]);
    }
    list.push_back(std::move(object));
  }
  return list;
}

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

std::string json_of(const Summary& summary) {
  Json json = Json::object();
  for (const auto& [key, content] : summary) {
    place_in(json, key) = std::visit([](const auto& c) { return json_of(c); }, content);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

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
