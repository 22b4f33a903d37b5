#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/shell/output_file.h"
#include "apps/textbook/drawing/picture.h"

namespace fathom::app::cases {

/// The name of a picture of steps as an argument.
/// Fails    UsageError: "'text' does not end in .svg".
std::string parse_svg_name(const std::string& text);

/// --draw FILE.svg: the pictures of all cases of a command, one below the other, in one file.
class StepsPicture {
 public:
  /// An empty name: no picture. Opened before the work.
  explicit StepsPicture(const std::string& name) {
    if (!name.empty()) output_.emplace(name);
  }
  [[nodiscard]] bool is_wanted() const { return output_.has_value(); }
  void add(drawing::Picture picture) { pictures_.push_back(std::move(picture)); }
  /// Writes the file, where one is wanted.
  void finish(const std::string& title) {
    if (output_) output_->finish(drawing::document(title, pictures_));
  }

 private:
  std::optional<TextOutput> output_;
  std::vector<drawing::Picture> pictures_;
};

}  // namespace fathom::app::cases
