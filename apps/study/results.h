#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "apps/study/page.h"
#include "apps/study/plot.h"
#include "apps/study/study.h"
#include "apps/study/table.h"

namespace fathom::studies {

/// The contents of summary.json in order: values, and tables as lists with an object for each row.
/// Keys may have members and lists, like the keys of columns.
using Summary = std::vector<std::pair<std::string, std::variant<Cell, Table>>>;

std::string json_of(const Summary& summary);

/// Collects the results of a study: the figures of summary.json, tables, plots and pictures, and
/// the page that shows them.
class Results {
 public:
  /// `page` is the study's Markdown (page.h). The options decide whether plots are drawn.
  Results(const std::string& study, std::string_view page, const StudyOptions& options);

  /// A figure of summary.json, which the page may quote as {{key}}, formatted as text_of() does.
  void figure(const std::string& key, const Cell& value, const char* page_format = "g");
  /// A figure that only the page quotes.
  void quote(const std::string& name, const Cell& value, const char* page_format = "g");

  /// The places of a table: the file CSV.csv, the key `json` of summary.json, the page's
  /// {{table:page}}. An empty name leaves the table out of that place.
  struct Places {
    std::string csv, json, page;
  };
  void table(const Table& table, const Places& places);

  /// Draws it, unless it has nothing to draw or plots are switched off.
  void plot(const Plot& plot);
  void plot(const BarChart& chart);
  void plot(const HeatMap& map);
  /// NAME.png, which the page may show as {{picture:NAME}}, `width` wide; 0: as it is.
  void picture(StudyFile png, std::uint32_t width = 0);
  /// And the command that draws it, which the page quotes as {{draw NAME}}.
  void picture(StudyFile png, const std::string& command, std::uint32_t width = 0);
  void pictures(std::vector<StudyFile> pngs);
  /// A file next to the page, such as a scene that a command in its captions reads.
  void file(StudyFile file);
  /// {{text:name}} of the page.
  void text(const std::string& name, const std::string& text);
  /// A plot whose files NAME.gp, NAME.png and NAME.svg are made by `draw`.
  void plot(const std::string& name, const std::function<std::vector<StudyFile>()>& draw);

  /// All files, summary.json and index.html among them.
  [[nodiscard]] std::vector<StudyFile> files() const;

 private:
  std::vector<StudyFile> files_;
  [[nodiscard]] std::string commands() const;

  Summary summary_;
  Page page_;
  std::string command_;  ///< that runs the study; the page quotes it as {{study}}
  bool plots_;
};

}  // namespace fathom::studies
