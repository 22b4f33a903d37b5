#include "fathom/failures/errors.h"
#include "tests/fuzz/fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fathom;
  using namespace fathom::fuzz;
  return one_input([&](const ReadOptions& options, Warnings& warnings) {
    return read_stl(std::as_bytes(std::span(data, size)), "input", options, warnings);
  });
}
