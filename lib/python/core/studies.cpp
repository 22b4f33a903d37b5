// The extension module _studies, which fathom.studies loads when a study is run: so what studies
// are made of, the textbooks' pipeline among it, does not slow down `import fathom`.

#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/study/study.h"
#include "apps/study/table.h"
#include "bindings.h"
#include "entry_points.h"
#include "fathom/failures/errors.h"
#include "running.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

using studies::StudyFile;
using studies::StudyOptions;

py::list names_of_studies() {
  py::list names;
  for (const studies::Study& study : studies::all_studies())
    names.append(py::make_tuple(study.name, study.description, study.takes_scene));
  return names;
}

/// A cell as an object of Python's; NaN where it is empty.
py::object object_of(const studies::Cell& cell, const char* format) {
  struct Convert {
    const studies::Cell& cell;
    const char* format;
    py::object operator()(std::monostate) const { return py::float_(std::nan("")); }
    py::object operator()(bool flag) const { return py::bool_(flag); }
    py::object operator()(double number) const { return py::float_(number); }
    py::object operator()(std::int64_t number) const { return py::int_(number); }
    py::object operator()(std::uint64_t number) const { return py::int_(number); }
    py::object operator()(const std::string& text) const { return py::str(text); }
    py::object operator()(const std::vector<double>&) const {
      return py::str(text_of(cell, format));
    }
  };
  return std::visit(Convert{cell, format}, cell.value);
}

/// As fathom.studies has it: of what type the array of a column is; "" where its cells tell.
const char* name_of(studies::CellKind kind) {
  switch (kind) {
    case studies::CellKind::flag:
      return "bool";
    case studies::CellKind::count:
      return "int64";
    case studies::CellKind::number:
      return "float64";
    case studies::CellKind::text:
      return "str";
    case studies::CellKind::any:
      break;
  }
  return "";
}

/// The columns that a CSV file has: (name, type, cells).
py::list columns_of(const studies::Table& table) {
  py::list columns;
  for (std::size_t i = 0; i < table.columns().size(); ++i) {
    const studies::Column& column = table.columns()[i];
    if (column.key.empty()) continue;
    py::list cells;
    for (const auto& row : table.rows()) cells.append(object_of(row[i], column.csv_format));
    columns.append(py::make_tuple(column.key, name_of(column.kind), cells));
  }
  return columns;
}

/// The files of a study by their names, and the tables of those that have one. The scene is looked
/// at through the camera that comes with it.
py::tuple run_study(const std::string& name, const SharedScene* scene, const Camera* camera,
                    const std::array<std::optional<double>, 3>& depths,
                    std::optional<std::uint32_t> samples, bool plots) {
  const studies::Study& study = studies::study_named(name);
  StudyOptions options;
  options.near = depths[0];
  options.far = depths[1];
  options.separation = depths[2];
  options.samples = samples;
  options.plots = plots;
  if (scene != nullptr && !study.takes_scene)
    throw UsageError("the study " + name + " takes no scene");
  if (scene != nullptr) options.scene = studies::SceneView{"scene", *scene->scene, *camera};
  const std::vector<StudyFile> files =
      run([&](const auto& progress) { return study.run(options, progress); });
  py::dict contents, tables;
  for (const StudyFile& file : files) {
    contents[py::str(file.name)] = py::bytes(file.content);
    if (file.table) tables[py::str(file.name)] = columns_of(*file.table);
  }
  return py::make_tuple(contents, tables);
}

}  // namespace
}  // namespace fathom::python

PYBIND11_MODULE(_studies, module) {
  using namespace fathom::python;
  module.doc() = "What fathom.studies calls.";
  Module studies(module);
  end_work_at_exit(studies);
  studies.def("names_of_studies", &names_of_studies).def("run_study", &run_study);
}
