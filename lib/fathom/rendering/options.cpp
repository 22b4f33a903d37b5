#include "fathom/rendering/options.h"

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/threads.h"

namespace fathom {

void require_meaningful(const RenderOptions& options) {
  const StandardArithmetic standard;
  require_thread_count(options.threads);
  if (options.channels.empty()) throw UsageError(Setting{"channels"}, "expected at least one");
  const DepthEncoding& encoding = options.depth_encoding;
  const auto is_positive = [](double x) { return x > 0 && std::isfinite(x); };
  if (encoding.type == StoredType::scaled_unorm16 &&
      !(is_positive(encoding.scale) && is_positive(encoding.divisor) &&
        is_positive(encoding.scale / encoding.divisor))) {
    throw UsageError(Setting{"depth_encoding.scale"}, "expected a positive number");
  }
  if (!(options.fast.widening >= 1 && std::isfinite(options.fast.widening))) {
    throw UsageError(Setting{"fast.widening"}, "expected a number of at least 1");
  }
}

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
