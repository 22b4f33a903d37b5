#include "apps/study/formats.h"

#include <limits>

namespace fathom::studies {
namespace {

std::string joined(const DepthFormat& format, const char* separator) {
  return std::string(name_of(format.mapping)) + separator + std::string(name_of(format.storage));
}

}  // namespace

DepthFormat format_between(double near, double far, Mapping mapping, Storage storage) {
  return {mapping, storage, near,
          takes_infinite_far(mapping) ? std::numeric_limits<double>::infinity() : far};
}

bool is_projection(Mapping mapping) {
  return mapping <= Mapping::opengl;
}

std::string label_of(const DepthFormat& format) {
  return joined(format, " ");
}

std::string file_name_of(const DepthFormat& format) {
  return joined(format, "-");
}

}  // namespace fathom::studies
