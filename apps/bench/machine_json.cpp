#include "apps/bench/machine_json.h"

#include <nlohmann/json.hpp>

namespace fathom::bench {

nlohmann::ordered_json to_json(const Machine& machine) {
  return {{"processor", machine.processor},
          {"processors", machine.processors},
          {"memory_bytes", machine.memory_bytes},
          {"system", machine.system},
          {"compiler", machine.compiler}};
}

}  // namespace fathom::bench
