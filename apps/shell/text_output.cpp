#include "apps/shell/text_output.h"

#include "apps/shell/standard_streams.h"

namespace fathom::app {

TextOutput::TextOutput(const std::string& name) : printed_(name == "-") {
  if (printed_) {
    expect_standard_output();
  } else if (!name.empty()) {
    file_.emplace(name);
  }
}

void TextOutput::write(const std::string& text) {
  if (file_) file_->write(text);
  if (printed_) text_ = text;
}

void TextOutput::print() const {
  if (printed_) app::print(text_);
}

void TextOutput::finish(const std::string& text) {
  write(text);
  if (file_) file_->commit();
  print();
}

}  // namespace fathom::app
