#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "fathom/attribution/attribute_and_name.h"
#include "fathom/attribution/background.h"
#include "fathom/attribution/cause.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model_choice.h"
#include "fathom/numeric/errors.h"
#include "maps.h"
#include "running.h"
#include "scene.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

using namespace attribution;

struct Judgement {
  std::string model;
  Attribution found;
  std::vector<Finding> notes;
  /// "" where nothing is wrong.
  std::string cause;
};

RendererModel model_for(const std::string& name, const Camera& camera) {
  RendererModel model = model_named(name);
  if (has_clip_planes_for(model, camera)) return model;
  throw UsageError("model " + name +
                   ": the camera has no near and far, between which its depths are stored");
}

void require_known_triangles(const OtherMap& other, const Scene& scene) {
  const std::uint64_t count = triangle_count(scene);
  for (const std::uint32_t triangle : other.triangles) {
    if (triangle == no_surface || triangle < count) continue;
    throw InputError("map: it shows triangle " + std::to_string(triangle) + ", but the scene has " +
                     std::to_string(count));
  }
}

Judgement judge(const DepthMap& map, const std::string& channel, const Scene& scene,
                const Camera& camera, const std::string& model) {
  std::optional<RendererModel> named;
  if (model != "auto") named = model_for(model, camera);
  OtherMap other = other_map(map, channel);
  require_known_triangles(other, scene);
  const Truth truth = make_truth(scene, camera);
  other = known_background(truth, other).map;
  Judgement judgement;
  if (named) {
    judgement = {model, attribute_and_name(truth, other, *named), {}, ""};
  } else {
    ModelTrial chosen = chosen_model(truth, other).chosen;
    judgement = {chosen.model.name, std::move(chosen.attribution), {}, ""};
  }
  judgement.notes = judgement.found.notes;
  judgement.cause = cause_of(truth, other, judgement.found);
  return judgement;
}

template <class T>
py::array image_of(const std::vector<T>& values, const Camera& camera) {
  return array_of(Samples<T>(values), {camera.height, camera.width});
}

py::dict validate(const SharedMap& map, const std::string& channel, const SharedScene& shared,
                  const Camera& camera, const std::string& model) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const Judgement judgement =
      run([&](const auto&) { return judge(*map, channel, *scene, camera, model); });
  const Attribution& found = judgement.found;
  Samples<std::uint8_t> classes(found.classes.size());
  for (std::size_t i = 0; i < classes.size(); ++i)
    classes[i] = static_cast<std::uint8_t>(found.classes[i]);
  py::dict result;
  result["model"] = judgement.model;
  result["cause"] = judgement.cause;
  result["classes"] = array_of(std::move(classes), {camera.height, camera.width});
  result["least"] = image_of(found.least, camera);
  result["greatest"] = image_of(found.greatest, camera);
  result["findings"] = found.findings;
  result["notes"] = judgement.notes;
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

void bind_validation(py::module_& core) {
  py::class_<Estimate>(core, "Estimate")
      .def_readonly("name", &Estimate::name)
      .def_readonly("value", &Estimate::value)
      .def_readonly("deviation", &Estimate::deviation)
      .def_readonly("unit", &Estimate::unit);
  py::class_<Finding>(core, "Finding")
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
