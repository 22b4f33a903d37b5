#include "arrays.h"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace py = pybind11;

namespace fathom::python {

#ifdef __linux__

namespace {

struct Mapping {
  explicit Mapping(std::size_t length) : bytes(length) {
    memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    madvise(memory, bytes, MADV_NOHUGEPAGE);  // a hint
  }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  ~Mapping() { munmap(memory, bytes); }

  void* memory = nullptr;
  std::size_t bytes;
};

}  // namespace

py::array array_in_small_pages(const Shape& shape, const py::dtype& type) {
  auto bytes = static_cast<std::size_t>(type.itemsize());
  for (const py::ssize_t side : shape) bytes *= static_cast<std::size_t>(side);
  if (bytes == 0) return py::array(type, shape);
  auto kept = std::make_unique<Mapping>(bytes);
  void* const memory = kept->memory;
  const py::capsule owner(kept.get(), [](void* mapping) { delete static_cast<Mapping*>(mapping); });
  static_cast<void>(kept.release());
  return py::array(type, shape, memory, owner);
}

#else

py::array array_in_small_pages(const Shape& shape, const py::dtype& type) {
  return py::array(type, shape);
}

#endif

}  // namespace fathom::python
