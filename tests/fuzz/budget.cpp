// What an input may cost: memory and processor time in proportion to its bytes. This is what
// libFuzzer calls; each target's own LLVMFuzzerTestOneInput is compiled as fathom_fuzz_one_input
// (see CMakeLists.txt). An input that costs more is a finding.
//
// The budget is generous: sanitizers make both many times as large, and other processes run beside.
// What is quadratic, or follows a number in the file, goes beyond it all the same.
#include <sanitizer/allocator_interface.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>

extern "C" int fathom_fuzz_one_input(const std::uint8_t* data, std::size_t size);

namespace {

/// FATHOM_FUZZ_SECONDS and FATHOM_FUZZ_MEBIBYTES are what an empty input may take.
constexpr double seconds_at_least = FATHOM_FUZZ_SECONDS, seconds_a_byte = 1e-3;
constexpr std::size_t bytes_at_least = std::size_t{FATHOM_FUZZ_MEBIBYTES} << 20,
                      bytes_a_byte = 4096;

/// What the heap holds, and the most that it has held since the last start.
std::atomic<std::ptrdiff_t> held{0}, most_held{0};

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

[[noreturn]] void refuse(std::size_t size, double cost, double most, const char* unit) {
  std::fprintf(stderr, "over budget: an input of %zu bytes took %.4g %s, more than %.4g\n", size,
               cost, unit, most);
  std::abort();
}

}  // namespace

// The address sanitizer calls these.
extern "C" void __sanitizer_malloc_hook(const volatile void*, std::size_t size) {
  const std::ptrdiff_t now =
      held.fetch_add(static_cast<std::ptrdiff_t>(size)) + static_cast<std::ptrdiff_t>(size);
  std::ptrdiff_t most = most_held.load();
  while (now > most && !most_held.compare_exchange_weak(most, now)) {
  }
}
extern "C" void __sanitizer_free_hook(const volatile void* memory) {
  if (memory != nullptr)
    held.fetch_sub(static_cast<std::ptrdiff_t>(__sanitizer_get_allocated_size(memory)));
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto length = static_cast<double>(size);
  const double most_seconds = seconds_at_least + seconds_a_byte * length;
  const auto most_bytes =
      static_cast<double>(bytes_at_least) + static_cast<double>(bytes_a_byte) * length;
  double seconds = 0;
  // A time is measured again before it is believed.
  for (int measured = 0; measured < 3; ++measured) {
    const std::ptrdiff_t before = held.load();
    most_held.store(before);
    const double start = processor_seconds();
    const int result = fathom_fuzz_one_input(data, size);
    seconds = processor_seconds() - start;
    const auto bytes = static_cast<double>(most_held.load() - before);
    if (bytes > most_bytes) refuse(size, bytes, most_bytes, "bytes of memory");
    if (seconds <= most_seconds) return result;
  }
  refuse(size, seconds, most_seconds, "seconds");
}
