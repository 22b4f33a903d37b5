#include "validation/variants/driver.h"

namespace fathom::validation {
namespace {

constexpr Driver named_drivers[] = {Driver::llvmpipe, Driver::softpipe};

}  // namespace

std::string name_of(Driver driver) {
  constexpr const char* names[] = {"", "llvmpipe", "softpipe"};
  return names[static_cast<std::size_t>(driver)];
}

std::optional<Driver> driver_named(std::string_view name) {
  for (const Driver driver : named_drivers) {
    if (name_of(driver) == name) return driver;
  }
  return std::nullopt;
}

std::string driver_names() {
  return "llvmpipe and softpipe";
}

}  // namespace fathom::validation
