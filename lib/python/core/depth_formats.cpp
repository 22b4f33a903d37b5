#include <pybind11/stl.h>

#include <limits>

#include "bindings.h"
#include "fathom/depth_format/encode.h"
#include "fathom/depth_format/resolution.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/threads.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

DepthFormat make_format(const std::string& mapping, const std::string& storage, double near,
                        double far, double c) {
  const DepthFormat format{mapping_named(mapping), storage_named(storage), near, far, c};
  require_meaningful(format);
  return format;
}

/// target[i] = function(source[i]) for all i, by all threads.
template <class Source, class Target, class Function>
py::array mapped(const ContiguousArray<Source>& source, const Function& function) {
  Samples<Target> target(static_cast<std::size_t>(source.size()));
  const Source* const first = source.data();
  run([&](const auto& progress) {
    constexpr std::size_t part = 1024;
    const std::size_t parts = (target.size() + part - 1) / part;
    Progress done(progress, parts);
    with_threads(0, [&] {
      parallel_for(std::size_t{0}, parts, [&](std::size_t number) {
        const StandardArithmetic standard;
        const std::size_t end = std::min((number + 1) * part, target.size());
        for (std::size_t i = number * part; i < end; ++i) target[i] = function(first[i]);
        done.part_done();
      });
    });
  });
  return array_of(std::move(target), Shape(source.shape(), source.shape() + source.ndim()));
}

Ratio depth_in(const DepthFormat& format, double depth, bool clamp) {
  if (depth != depth) throw InputError("depths: expected numbers, found NaN");
  if (depth == std::numeric_limits<double>::infinity()) {
    if (!clamp) throw InputError("depths: expected finite numbers, found infinity");
    depth = std::numeric_limits<double>::max();
  }
  if (depth == -std::numeric_limits<double>::infinity()) {
    if (!clamp) throw InputError("depths: expected finite numbers, found -infinity");
    depth = std::numeric_limits<double>::lowest();
  }
  const Ratio exact = Dyadic(depth);
  return clamp ? clamp_to_range(format, exact) : exact;
}

py::array encode_depths(const DepthFormat& format, const ContiguousArray<double>& depths,
                        bool clamp) {
  return mapped<double, std::uint64_t>(
      depths, [&](double depth) { return encode(format, depth_in(format, depth, clamp)).bits; });
}

/// function(stored value) for each; a value that is none is refused.
template <class Function>
py::array of_stored(const DepthFormat& format, const ContiguousArray<std::uint64_t>& stored,
                    const Function& function) {
  const std::uint64_t greatest = greatest_stored(format.storage).bits;
  return mapped<std::uint64_t, double>(stored, [&](std::uint64_t bits) {
    if (bits > greatest) {
      throw InputError("stored: expected values from 0 to " + std::to_string(greatest) +
                       ", found " + std::to_string(bits));
    }
    return function(StoredDepth{bits});
  });
}

template <class Function>
py::array of_depths(const DepthFormat& format, const ContiguousArray<double>& depths,
                    const Function& function) {
  return mapped<double, double>(
      depths, [&](double depth) { return function(depth_in(format, depth, false)); });
}

/// NaN where there is no such distance.
double or_nan(const std::optional<double>& distance) {
  return distance.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

void bind_depth_formats(Module& core) {
  Class<DepthFormat>(core, "DepthFormat")
      .def(py::init(&make_format))
      .def("encode", &encode_depths)
      .def("decode",
           [](const DepthFormat& format, const ContiguousArray<std::uint64_t>& stored) {
             return of_stored(format, stored,
                              [&](StoredDepth each) { return decode_to_binary64(format, each); });
           })
      .def("values",
           [](const DepthFormat& format, const ContiguousArray<std::uint64_t>& stored) {
             return of_stored(format, stored, [&](StoredDepth each) {
               return round_to_binary64(value_of(format.storage, each));
             });
           })
      .def("to_nearer",
           [](const DepthFormat& format, const ContiguousArray<double>& depths) {
             return of_depths(format, depths, [&](const Ratio& depth) {
               return or_nan(resolution(format, depth).to_nearer);
             });
           })
      .def("to_farther",
           [](const DepthFormat& format, const ContiguousArray<double>& depths) {
             return of_depths(format, depths, [&](const Ratio& depth) {
               return or_nan(resolution(format, depth).to_farther);
             });
           })
      .def("separation_behind",
           [](const DepthFormat& format, const ContiguousArray<double>& depths) {
             return of_depths(format, depths, [&](const Ratio& depth) {
               return or_nan(separation_behind(format, depth));
             });
           })
      .def("bin_width",
           [](const DepthFormat& format, const ContiguousArray<double>& depths) {
             return of_depths(format, depths,
                              [&](const Ratio& depth) { return bin_width(format, depth); });
           })
      .def("codes_between",
           [](const DepthFormat& format, double nearest, double farthest) {
             return codes_between(format, depth_in(format, nearest, false),
                                  depth_in(format, farthest, false));
           })
      .def_property_readonly("greatest", [](const DepthFormat& format) {
        return greatest_stored(format.storage).bits;
      });
  core.attr("mappings") = names_of(all_mappings);
  core.attr("storages") = names_of(all_storages);
}

}  // namespace fathom::python
