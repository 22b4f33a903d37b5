#include "apps/bench/json_report.h"

#include "apps/shell/standard_streams.h"

namespace fathom::app {

JsonReport::JsonReport(const std::string& file) : on_standard_output_(file == "-") {
  if (!file.empty() && !on_standard_output_) file_.emplace(file);
}

void JsonReport::write(const std::string& report) {
  if (on_standard_output_) print(report);
  if (!file_) return;
  file_->write(report);
  file_->commit();
}

}  // namespace fathom::app
