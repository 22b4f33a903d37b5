#include <pybind11/stl.h>

#include "attributes.h"
#include "bindings.h"
#include "fathom/attribution/cause.h"
#include "fathom/attribution/judgement.h"
#include "fathom/attribution/model/named_models.h"
#include "objects.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

using namespace attribution;

py::dict validate(const SharedMap& map, const std::string& channel, const SharedScene& shared,
                  const Camera& camera, const std::string& model) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const Judgement judged = run([&](const auto&) {
    std::optional<RendererModel> named;
    if (model != "auto") named = model_for(model, camera);
    return judge_map("map", other_map(*map, channel), *scene, camera, named);
  });
  const Camera& seen_by = judged.truth->camera;
  const Shape shape{seen_by.height, seen_by.width};
  const Attribution& found = judged.attribution;
  Samples<std::uint8_t> classes(found.classes.size());
  for (std::size_t i = 0; i < classes.size(); ++i)
    classes[i] = static_cast<std::uint8_t>(found.classes[i]);
  py::dict result;
  result["model"] = judged.model.name;
  result["cause"] = cause_of(*judged.truth, judged.other, found);
  result["verdict"] = verdict_text(*judged.truth, judged.other, found);
  result["camera"] = seen_by;
  result["classes"] = array_of(std::move(classes), shape);
  result["least"] = array_of(Samples(found.least), shape);
  result["greatest"] = array_of(Samples(found.greatest), shape);
  result["findings"] = found.findings;
  result["notes"] = found.notes;
  return result;
}

std::vector<std::string> class_names() {
  std::vector<std::string> names;
  names.reserve(pixel_class_count);
  for (std::size_t i = 0; i < pixel_class_count; ++i)
    names.push_back(name_of(static_cast<PixelClass>(i)));
  return names;
}

}  // namespace

void bind_validation(Module& core) {
  Class<Estimate>(
      core, "Estimate",
      "A quantity that was estimated from a map: value and standard deviation in `unit` "
      "(pixels, scene units, rad or empty).")
      .def_readonly("name", &Estimate::name)
      .def_readonly("value", &Estimate::value)
      .def_readonly("deviation", &Estimate::deviation)
      .def_readonly("unit", &Estimate::unit)
      .def("__repr__", Attributes("Estimate", {"name", "value", "deviation", "unit"}));
  Class<Finding>(
      core, "Finding",
      "A result about a map, mostly a fault: its `kind`, a clause (`text`), the number of "
      "`pixels` that it explains, estimates, other kinds that fit equally well "
      "(`alternatives`) and `evidence`.")
      .def_readonly("kind", &Finding::kind)
      .def_readonly("text", &Finding::text)
      .def_readonly("pixels", &Finding::pixels)
      .def_readonly("estimates", &Finding::estimates)
      .def_readonly("alternatives", &Finding::alternatives)
      .def_readonly("evidence", &Finding::evidence)
      .def("__repr__", [](const Finding& finding) { return finding_line(finding); });
  core.def("validate", &validate);
  core.attr("class_names") = class_names();
  core.attr("model_names") = model_names();
}

}  // namespace fathom::python
