#include "fathom/area/areas.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "fathom/rendering/options.h"
#include "fathom/threads/threads.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

using Numbers = ContiguousArray<double>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A scene and the items whose areas are asked for.
struct AreaQuestion {
  std::shared_ptr<const Scene> scene;
  AreaItemKind kind = AreaItemKind::object;
  AreaItems items;
};
using SharedQuestion = std::shared_ptr<const AreaQuestion>;

std::shared_ptr<AreaQuestion> area_question(const SharedScene& shared, const std::string& by) {
  auto question = std::make_shared<AreaQuestion>();
  question->scene = shared.scene;
  question->kind = named_value("by", all_area_item_kinds, by);
  run([&](const auto&) { question->items = area_items(*question->scene, question->kind); });
  return question;
}

/// Names, numbers, and of triangles and faces their objects and faces, else None.
py::tuple items_of(const SharedQuestion& question) {
  py::list names;
  std::vector<std::uint64_t> numbers;
  std::vector<std::uint32_t> objects, faces;
  for (const AreaItem& item : question->items.items) {
    names.append(py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(
        item.name.data(), static_cast<py::ssize_t>(item.name.size()), "backslashreplace")));
    numbers.push_back(item.number);
    if (item.object) objects.push_back(*item.object);
    if (item.face) faces.push_back(*item.face);
  }
  const bool has_origins =
      question->kind == AreaItemKind::triangle || question->kind == AreaItemKind::face;
  const auto or_none = [&](std::vector<std::uint32_t>& some) -> py::object {
    if (!has_origins) return py::none();
    return array_of(std::move(some));
  };
  return py::make_tuple(names, array_of(std::move(numbers)), or_none(objects), or_none(faces));
}

AreaOptions area_options(const AreaQuestion& question, const std::string& centroid, bool alone,
                         const std::string& cull) {
  AreaOptions options = options_of(question.items);
  options.centroid = centroid == "lit" ? AreaCentroid::lit : AreaCentroid::across;
  options.alone = alone;
  options.cull = named_value("cull", all_culls, cull);
  return options;
}

/// Areas of N lights and M items: N×M, centroids N×M×3.
class AreaArrays {
 public:
  AreaArrays(std::size_t lights, std::size_t items, bool has_sides)
      : lights_(lights),
        items_(items),
        visible_(lights * items),
        projected_(lights * items),
        fraction_(lights * items),
        lit_(lights * items),
        centroid_(3 * lights * items),
        sides_(has_sides ? lights * items : 0) {}

  void set(std::size_t light, const std::vector<LitArea>& areas) {
    for (std::size_t k = 0; k < areas.size(); ++k) {
      const std::size_t at = light * items_ + k;
      const LitArea& area = areas[k];
      visible_[at] = area.visible.value_or(nan);
      projected_[at] = area.projected.value_or(nan);
      fraction_[at] = area.fraction.value_or(nan);
      lit_[at] = area.lit;
      const std::array<double, 3> none{nan, nan, nan};
      std::ranges::copy(area.centroid.value_or(none), centroid_.begin() + 3 * at);
      if (!sides_.empty()) sides_[at] = sign_of(area.side.value_or(LitSide::edge));
    }
  }

  py::tuple take() {
    const Shape shape{size(lights_), size(items_)};
    py::object sides = py::none();
    if (!sides_.empty()) sides = array_of(std::move(sides_), shape);
    return py::make_tuple(array_of(std::move(visible_), shape),
                          array_of(std::move(projected_), shape),
                          array_of(std::move(fraction_), shape), array_of(std::move(lit_), shape),
                          array_of(std::move(centroid_), {size(lights_), size(items_), 3}), sides);
  }

 private:
  static py::ssize_t size(std::size_t n) { return static_cast<py::ssize_t>(n); }
  static std::int8_t sign_of(LitSide side) {
    return side == LitSide::edge ? 0 : side == LitSide::front ? 1 : -1;
  }

  std::size_t lights_, items_;
  Samples<double> visible_, projected_, fraction_, lit_, centroid_;
  Samples<std::int8_t> sides_;
};

/// The areas of `count` lights, by measure(light, options); several lights at the same time.
template <class Measure>
py::tuple measured(const AreaQuestion& question, std::size_t count, AreaOptions options,
                   int threads, const Measure& measure) {
  AreaArrays arrays(count, question.items.items.size(), question.kind == AreaItemKind::triangle);
  options.threads = count > 1 ? 1 : threads;
  run([&](const auto& progress) {
    with_threads(threads, [&] {
      in_parallel(count, [&](std::size_t light) {
        progress(0);
        arrays.set(light, measure(light, options));
      });
    });
  });
  return arrays.take();
}

std::array<double, 3> row_of(const Numbers& numbers, std::size_t row) {
  return {numbers.data()[3 * row], numbers.data()[3 * row + 1], numbers.data()[3 * row + 2]};
}

std::vector<LitArea> areas_of(const Scene& scene, const std::array<double, 3>& light,
                              bool are_points, const AreaOptions& options) {
  return are_points ? areas_from_point(scene, light, options)
                    : areas_in_direction(scene, light, options);
}

py::tuple light_areas(const SharedQuestion& question, const Numbers& lights, bool are_points,
                      const std::string& centroid, bool alone, const std::string& cull,
                      int threads) {
  std::vector<std::array<double, 3>> rows;
  for (py::ssize_t row = 0; row < lights.shape(0); ++row) {
    rows.push_back(row_of(lights, static_cast<std::size_t>(row)));
  }
  return measured(*question, rows.size(), area_options(*question, centroid, alone, cull), threads,
                  [&](std::size_t light, const AreaOptions& options) {
                    return areas_of(*question->scene, rows[light], are_points, options);
                  });
}

py::tuple camera_areas(const SharedQuestion& question, const std::vector<Camera>& cameras,
                       bool alone, const std::string& cull, int threads) {
  return measured(*question, cameras.size(), area_options(*question, "lit", alone, cull), threads,
                  [&](std::size_t light, const AreaOptions& options) {
                    return areas_from_camera(*question->scene, cameras[light], options);
                  });
}

double background(const SharedQuestion& question, const Camera& camera, const std::string& cull,
                  int threads) {
  AreaOptions options;
  options.cull = named_value("cull", all_culls, cull);
  options.threads = threads;
  return run(
      [&](const auto&) { return background_from_camera(*question->scene, camera, options); });
}

/// Options that measure an item alone before rounding; its place among their areas.
std::pair<AreaOptions, std::size_t> only(const AreaQuestion& question, std::size_t item, bool alone,
                                         const std::string& cull, int threads) {
  AreaOptions options = area_options(question, "lit", alone, cull);
  options.threads = threads;
  options.exact = true;
  if (question.items.of_triangle.empty()) return {options, item};
  for (std::uint32_t& group : options.groups) {
    group = group == item ? 0 : AreaOptions::no_group;
  }
  options.group_count = 1;
  return {options, 0};
}

/// Visible and projected areas as in ExactArea, each as parts_of() or None.
py::tuple exact_parts(const LitArea& area) {
  const auto parts = [](const std::optional<Ratio>& ratio) -> py::object {
    if (!ratio) return py::none();
    return parts_of(*ratio);
  };
  return py::make_tuple(parts(area.exact->visible), parts(area.exact->projected));
}

py::tuple exact_light_area(const SharedQuestion& question, const Numbers& light, bool are_points,
                           std::size_t item, bool alone, const std::string& cull, int threads) {
  const auto [options, place] = only(*question, item, alone, cull, threads);
  const std::array<double, 3> numbers = row_of(light, 0);
  return exact_parts(run([&, &asked = options](const auto&) {
    return areas_of(*question->scene, numbers, are_points, asked);
  })[place]);
}

py::tuple exact_camera_area(const SharedQuestion& question, const Camera& camera, std::size_t item,
                            bool alone, const std::string& cull, int threads) {
  const auto [options, place] = only(*question, item, alone, cull, threads);
  return exact_parts(run([&, &asked = options](const auto&) {
    return areas_from_camera(*question->scene, camera, asked);
  })[place]);
}

}  // namespace

void bind_areas(Module& core) {
  const Class<AreaQuestion, std::shared_ptr<AreaQuestion>> question(core, "AreaQuestion");
  core.def("area_question", &area_question);
  core.def("area_items", &items_of);
  core.def("light_areas", &light_areas);
  core.def("camera_areas", &camera_areas);
  core.def("background_area", &background);
  core.def("exact_light_area", &exact_light_area);
  core.def("exact_camera_area", &exact_camera_area);
}

}  // namespace fathom::python
