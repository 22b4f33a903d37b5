#pragma once

#include <pybind11/pybind11.h>

#include <utility>

#include "fathom/numeric/standard_arithmetic.h"

/// The only way to define functions and classes of an extension module: whatever is defined runs in
/// StandardArithmetic, so that a binding cannot forget it.
namespace fathom::python {

using InStandardArithmetic = pybind11::call_guard<StandardArithmetic>;

/// pybind11::module_, of what bindings use.
class Module {
 public:
  explicit Module(pybind11::module_ module) : module_(std::move(module)) {}

  template <class Function>
  Module& def(const char* name, Function&& function) {
    module_.def(name, std::forward<Function>(function), InStandardArithmetic());
    return *this;
  }
  /// For constants.
  auto attr(const char* name) { return module_.attr(name); }

  [[nodiscard]] pybind11::handle handle() const { return module_; }

 private:
  pybind11::module_ module_;
};

/// pybind11::class_, of what bindings use.
template <class T, class... Options>
class Class {
 public:
  Class(const Module& module, const char* name, const char* doc = "")
      : class_(module.handle(), name, doc) {}

  /// `constructor`: of pybind11::init().
  template <class Constructor>
  Class& def(Constructor&& constructor) {
    class_.def(std::forward<Constructor>(constructor), InStandardArithmetic());
    return *this;
  }
  template <class Function>
  Class& def(const char* name, Function&& function) {
    class_.def(name, std::forward<Function>(function), InStandardArithmetic());
    return *this;
  }
  // pybind11 takes a guard only together with the function that it guards.
  template <class Getter>
  Class& def_property_readonly(const char* name, const Getter& getter) {
    const pybind11::cpp_function guarded(pybind11::method_adaptor<T>(getter),
                                         pybind11::is_method(class_), InStandardArithmetic());
    class_.def_property_readonly(name, guarded, pybind11::return_value_policy::reference_internal);
    return *this;
  }
  /// Members are copied: that computes nothing.
  template <class Member>
  Class& def_readonly(const char* name, Member member) {
    class_.def_readonly(name, member);
    return *this;
  }
  template <class Member>
  Class& def_readwrite(const char* name, Member member) {
    class_.def_readwrite(name, member);
    return *this;
  }

 private:
  pybind11::class_<T, Options...> class_;
};

}  // namespace fathom::python
