#pragma once

#include <string>
#include <vector>

#include "validation/studies/study.h"

namespace fathom::studies {

/// The page of a study: text with plots and tables, in plain HTML.
class Page {
 public:
  explicit Page(const std::string& title);
  Page& heading(const std::string& text);
  Page& paragraph(const std::string& text);
  /// The plot NAME.png, linked to NAME.svg.
  Page& plot(const std::string& name, const std::string& caption);
  /// The picture NAME.png, its pixels kept sharp. Pictures and texts stand side by side where there
  /// is room.
  Page& picture(const std::string& name, const std::string& caption);
  /// Text as it is, every character of the same width.
  Page& preformatted(const std::string& text, const std::string& caption);
  Page& table(const std::vector<std::string>& head,
              const std::vector<std::vector<std::string>>& rows);
  /// index.html
  [[nodiscard]] StudyFile file() const;

 private:
  std::string body_;
  std::string title_;
};

}  // namespace fathom::studies
