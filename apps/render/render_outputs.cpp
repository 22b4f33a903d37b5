#include "apps/render/render_outputs.h"

#include "apps/render/map_names.h"

namespace fathom::app {

RenderOutputs::Note::Note(const std::string& name) : printed_(name == "-") {
  if (!name.empty() && !printed_) file_.emplace(name);
}

void RenderOutputs::Note::write(const std::string& text) {
  if (file_) file_->write(text);
  if (printed_) text_ = text;
}

void RenderOutputs::Note::commit() {
  if (file_) file_->commit();
}

void RenderOutputs::Note::print() const {
  if (printed_) app::print(text_);
}

RenderOutputs::RenderOutputs(const RenderArguments& arguments, std::size_t cameras)
    : names_(names_of_outputs("-o", arguments.output, cameras)),
      maps_(names_.begin(), names_.end()),
      cameras_(arguments.save_camera),
      statistics_(arguments.statistics) {
  if (arguments.image.empty()) return;
  for (const std::string& name : names_of_outputs("--image", arguments.image, cameras)) {
    pictures_.emplace_back(name);
  }
}

void RenderOutputs::commit() {
  cameras_.commit();
  statistics_.commit();
  for (OutputFile& output : pictures_) output.commit();
  for (OutputFile& output : maps_) output.commit();
  cameras_.print();
  statistics_.print();
}

}  // namespace fathom::app
