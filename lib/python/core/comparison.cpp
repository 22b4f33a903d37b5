// How two maps differ: figures, and a picture.

#include <pybind11/stl.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "fathom/attribution/attribution.h"
#include "fathom/attribution/judgement.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/image/compare.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

/// A `__repr__` that shows attributes as a call: Estimate(name='x', value=-0.5). Leaves out an
/// attribute that is None.
class Attributes {
 public:
  Attributes(std::string type, std::vector<std::string> names)
      : type_(std::move(type)), names_(std::move(names)) {}

  std::string operator()(const py::object& self) const {
    std::string text;
    for (const std::string& name : names_) {
      const py::object value = self.attr(name.c_str());
      if (value.is_none()) continue;
      text += (text.empty() ? "" : ", ") + name + "=" + std::string(py::repr(value));
    }
    return type_ + "(" + text + ")";
  }

 private:
  std::string type_;
  std::vector<std::string> names_;
};

CompareOptions make_options(const std::string& channel, const std::string& other_channel,
                            const std::array<double, 3>& tolerances,
                            const std::array<std::optional<double>, 2>& backgrounds,
                            const std::string& metrics) {
  CompareOptions options;
  options.channel = channel;
  options.other_channel = other_channel;
  options.tolerance_ulp = tolerances[0];
  options.tolerance_absolute = tolerances[1];
  options.tolerance_relative = tolerances[2];
  options.truth_background = backgrounds[0];
  options.other_background = backgrounds[1];
  options.metrics = metrics == "channel"     ? Metrics::by_channel
                    : metrics == "disparity" ? Metrics::of_disparity
                                             : Metrics::none;
  return options;
}

DifferenceMeasure measure_named(const std::string& name) {
  if (name == "ulp") return DifferenceMeasure::ulp;
  return name == "relative" ? DifferenceMeasure::relative : DifferenceMeasure::absolute;
}

void bind_metrics(Module& core) {
  Class<DepthMetrics>(core, "DepthMetrics",
                      "Metrics of depth benchmarks over the pixels where both maps show a surface.")
      .def_readonly("pixels", &DepthMetrics::pixels)
      .def_readonly("left_out", &DepthMetrics::left_out)
      .def_readonly("abs_rel", &DepthMetrics::abs_rel)
      .def_readonly("sq_rel", &DepthMetrics::sq_rel)
      .def_readonly("rmse", &DepthMetrics::rmse)
      .def_readonly("rmse_log", &DepthMetrics::rmse_log)
      .def_readonly("mae", &DepthMetrics::mae)
      .def_readonly("delta_1", &DepthMetrics::delta_1)
      .def_readonly("delta_2", &DepthMetrics::delta_2)
      .def_readonly("delta_3", &DepthMetrics::delta_3)
      .def("__repr__",
           Attributes("DepthMetrics", {"pixels", "left_out", "abs_rel", "sq_rel", "rmse",
                                       "rmse_log", "mae", "delta_1", "delta_2", "delta_3"}));
  Class<DisparityMetrics>(
      core, "DisparityMetrics",
      "Metrics of stereo benchmarks over the pixels with two disparities; bad_1 is the "
      "share that is off by more than 1 pixel.")
      .def_readonly("pixels", &DisparityMetrics::pixels)
      .def_readonly("left_out", &DisparityMetrics::left_out)
      .def_readonly("epe", &DisparityMetrics::epe)
      .def_readonly("rmse", &DisparityMetrics::rmse)
      .def_readonly("bad_0_5", &DisparityMetrics::bad_0_5)
      .def_readonly("bad_1", &DisparityMetrics::bad_1)
      .def_readonly("bad_2", &DisparityMetrics::bad_2)
      .def("__repr__", Attributes("DisparityMetrics", {"pixels", "left_out", "epe", "rmse",
                                                       "bad_0_5", "bad_1", "bad_2"}));
  Class<DifferenceSummary>(
      core, "DifferenceSummary",
      "Greatest, mean and percentiles of differences; `worst` is the pixel (x, y) of "
      "the greatest.")
      .def_readonly("max", &DifferenceSummary::max)
      .def_readonly("mean", &DifferenceSummary::mean)
      .def_readonly("p50", &DifferenceSummary::p50)
      .def_readonly("p90", &DifferenceSummary::p90)
      .def_readonly("p99", &DifferenceSummary::p99)
      .def_readonly("p99_9", &DifferenceSummary::p99_9)
      .def_property_readonly("worst",
                             [](const DifferenceSummary& summary) {
                               return std::pair(summary.worst.x, summary.worst.y);
                             })
      .def("__repr__",
           Attributes("DifferenceSummary", {"max", "mean", "p50", "p90", "p99", "p99_9", "worst"}));
}

void bind_channel_comparison(Module& core) {
  Class<ChannelComparison>(core, "ChannelComparison",
                           "The differences between a channel of two maps: counts of pixels and "
                           "DifferenceSummary objects.")
      .def_readonly("truth_channel", &ChannelComparison::truth_channel)
      .def_readonly("other_channel", &ChannelComparison::other_channel)
      .def_readonly("pixels", &ChannelComparison::pixels)
      .def_readonly("both", &ChannelComparison::both)
      .def_readonly("only_truth", &ChannelComparison::only_truth)
      .def_readonly("only_other", &ChannelComparison::only_other)
      .def_readonly("neither", &ChannelComparison::neither)
      .def_readonly("compared", &ChannelComparison::compared)
      .def_readonly("bit_equal", &ChannelComparison::bit_equal)
      .def_readonly("incommensurable", &ChannelComparison::incommensurable)
      .def_readonly("different_identifiers", &ChannelComparison::different_identifiers)
      .def_readonly("beyond_tolerance", &ChannelComparison::beyond_tolerance)
      .def_readonly("absolute", &ChannelComparison::absolute)
      .def_readonly("relative", &ChannelComparison::relative)
      .def_readonly("ulp", &ChannelComparison::ulp)
      .def_readonly("notes", &ChannelComparison::notes)
      .def_readonly("depth_metrics", &ChannelComparison::depth_metrics)
      .def_readonly("disparity_metrics", &ChannelComparison::disparity_metrics)
      .def_property_readonly("within_tolerance", &ChannelComparison::within_tolerance)
      .def("__repr__", [](const ChannelComparison& channel) {
        const double share = channel.both == 0 ? 1
                                               : static_cast<double>(channel.bit_equal) /
                                                     static_cast<double>(channel.both);
        py::str text = py::str("ChannelComparison({}: {:.4g} % of {} pixels are bit-equal")
                           .format(channel.truth_channel, 100 * share, channel.both);
        if (channel.absolute.max > 0)
          text = text + py::str("; differences up to {:.6g}, mean {:.6g}")
                            .format(channel.absolute.max, channel.absolute.mean);
        if (channel.different_identifiers > 0)
          text = text + py::str("; {} identifiers differ").format(channel.different_identifiers);
        text = text + py::str("; a surface only in truth: {}, only in other: {}")
                          .format(channel.only_truth, channel.only_other);
        return text + py::str(channel.within_tolerance() ? "; within tolerance)"
                                                         : "; not within tolerance)");
      });
}

}  // namespace

void bind_comparison(Module& core) {
  bind_metrics(core);
  bind_channel_comparison(core);
  Class<MapComparison>(core, "MapComparison")
      .def_readonly("channels", &MapComparison::channels)
      .def_readonly("only_in_truth", &MapComparison::only_in_truth)
      .def_readonly("only_in_other", &MapComparison::only_in_other)
      .def_readonly("notes", &MapComparison::notes)
      .def_property_readonly("within_tolerance", &MapComparison::within_tolerance)
      .def("__repr__", Attributes("MapComparison", {"within_tolerance", "channels"}));
  Class<CompareOptions>(core, "CompareOptions").def(py::init(&make_options));
  core.def("compare_maps",
           [](const SharedMap& truth, const SharedMap& other, const CompareOptions& options) {
             return run([&](const auto&) { return compare_maps(*truth, *other, options); });
           });
  core.def("draw_differences", [](const SharedMap& truth, const SharedMap& other,
                                  const CompareOptions& options, const std::string& by) {
    return array_of(run(
        [&](const auto&) { return draw_differences(*truth, *other, options, measure_named(by)); }));
  });
}

// Why another renderer's map differs from the truth.

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
  const Camera& seen_by = whole_camera(*judged.truth);
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
