#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

namespace fathom::python {

/// A `__repr__` that shows attributes as a call: Estimate(name='x', value=-0.5). Leaves out an
/// attribute that is None.
class Attributes {
 public:
  Attributes(std::string type, std::vector<std::string> names)
      : type_(std::move(type)), names_(std::move(names)) {}

  std::string operator()(const pybind11::object& self) const {
    std::string text;
    for (const std::string& name : names_) {
      const pybind11::object value = self.attr(name.c_str());
      if (value.is_none()) continue;
      text += (text.empty() ? "" : ", ") + name + "=" + std::string(pybind11::repr(value));
    }
    return type_ + "(" + text + ")";
  }

 private:
  std::string type_;
  std::vector<std::string> names_;
};

}  // namespace fathom::python
