#include "fathom/rendering/option_names.h"

namespace fathom {

std::string_view name_of(Engine engine) {
  return engine == Engine::fast ? "fast" : "reference";
}

std::string_view name_of(Cull cull) {
  return cull == Cull::back ? "back" : cull == Cull::front ? "front" : "none";
}

std::string_view name_of(StoredType type) {
  return type == StoredType::binary32   ? "float32"
         : type == StoredType::binary64 ? "float64"
                                        : "uint16";
}

}  // namespace fathom
