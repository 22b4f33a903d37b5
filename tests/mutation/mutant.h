/// What `scripts/dev/mutate` puts in place of operators and numbers (tests/mutation/instrument.py):
/// each does what stood there, unless its mutant is the chosen one. All mutants are compiled in;
/// FATHOM_MUTANT chooses one at run time.
///
/// A mutant exists where code is made for it: constant expressions stay as they are, and where the
/// types have no such operator there is none. The numbers of those that exist stand in the section
/// .fathom_mutants of the object files.
///
/// With FATHOM_MUTANT_TRACE, a folder, and FATHOM_MUTANT_TEST, the name of a file in it, each
/// mutant that is executed sets a byte of that file, which all processes of a test map into their
/// memory.
#pragma once
#pragma GCC system_header

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <concepts>
#include <cstdlib>
#include <string>
#include <type_traits>
#include <utility>

namespace fathom_mutant {

constexpr int most = 1 << 16;

/// Bytes that nobody reads, or those of the test's file.
inline unsigned char* trace_of(const char* test) {
  static unsigned char nobody_reads[most];
  const char* folder = std::getenv("FATHOM_MUTANT_TRACE");
  if (folder == nullptr || test == nullptr) return nobody_reads;
  const std::string path = std::string(folder) + "/" + test;
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  struct stat status {};
  if (file < 0 || ::fstat(file, &status) != 0) return nobody_reads;
  if (status.st_size < most && ::ftruncate(file, most) != 0) return nobody_reads;
  void* bytes = ::mmap(nullptr, most, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  ::close(file);
  return bytes == MAP_FAILED ? nobody_reads : static_cast<unsigned char*>(bytes);
}

inline int number_of(const char* text) {
  return text == nullptr ? -1 : std::atoi(text);
}

inline const int chosen = number_of(std::getenv("FATHOM_MUTANT"));
inline unsigned char* reached = trace_of(std::getenv("FATHOM_MUTANT_TEST"));

/// Whether mutant n is the chosen one. Notes that it was reached, and in the object file that it
/// exists.
template <int n>
[[gnu::always_inline]] inline bool on() {
  static_assert(n < most);
  asm volatile(".pushsection .fathom_mutants,\"\",@progbits\n.long %c0\n.popsection" : : "i"(n));
  reached[n] = 1;
  return chosen == n;
}

// What stood there, or a second operator; for comparisons also their opposite. There is a mutant
// only where the second one gives the same type; of comparisons, a type may have just the one that
// is used.
#define FATHOM_MUTANT_OPERATOR(name, original, other)                      \
  template <int n, class L, class R>                                       \
  [[gnu::always_inline]] constexpr decltype(auto) name(L&& l, R&& r) {     \
    if constexpr (requires {                                               \
                    { l other r } -> std::same_as<decltype(l original r)>; \
                  }) {                                                     \
      if (!std::is_constant_evaluated() && on<n>()) {                      \
        return std::forward<L>(l) other std::forward<R>(r);                \
      }                                                                    \
    }                                                                      \
    return std::forward<L>(l) original std::forward<R>(r);                 \
  }
#define FATHOM_MUTANT_COMPARISON(name, original, other)                     \
  template <int n, class L, class R>                                        \
  [[gnu::always_inline]] constexpr bool name(L&& l, R&& r) {                \
    if (!std::is_constant_evaluated()) {                                    \
      if constexpr (requires { static_cast<bool>(l other r); }) {           \
        if (on<n>()) return static_cast<bool>(l other r);                   \
      } else if constexpr (requires { static_cast<bool>(r original l); }) { \
        if (on<n>()) return !static_cast<bool>(r original l);               \
      }                                                                     \
      if (on<n + 1>()) return !static_cast<bool>(l original r);             \
    }                                                                       \
    return static_cast<bool>(l original r);                                 \
  }
FATHOM_MUTANT_OPERATOR(plus, +, -)
FATHOM_MUTANT_OPERATOR(minus, -, +)
FATHOM_MUTANT_OPERATOR(plus_assign, +=, -=)
FATHOM_MUTANT_OPERATOR(minus_assign, -=, +=)
FATHOM_MUTANT_OPERATOR(equal, ==, !=)
FATHOM_MUTANT_OPERATOR(unequal, !=, ==)
FATHOM_MUTANT_COMPARISON(less, <, <=)
FATHOM_MUTANT_COMPARISON(less_equal, <=, <)
FATHOM_MUTANT_COMPARISON(greater, >, >=)
FATHOM_MUTANT_COMPARISON(greater_equal, >=, >)
#undef FATHOM_MUTANT_OPERATOR
#undef FATHOM_MUTANT_COMPARISON

/// -x, or x.
template <int n, class T>
[[gnu::always_inline]] constexpr auto negative(T&& x) {
  using Result = std::decay_t<decltype(-std::forward<T>(x))>;
  if constexpr (std::constructible_from<Result, T>) {
    if (!std::is_constant_evaluated() && on<n>()) return Result(std::forward<T>(x));
  }
  return Result(-std::forward<T>(x));
}

/// A number, or another one.
template <int n, class T>
[[gnu::always_inline]] constexpr T number(T original, T other) {
  if (!std::is_constant_evaluated() && on<n>()) return other;
  return original;
}
template <int n, class T>
[[gnu::always_inline]] constexpr T number(T original, T other, T third) {
  if (!std::is_constant_evaluated()) {
    if (on<n>()) return other;
    if (on<n + 1>()) return third;
  }
  return original;
}

/// A truth value, or its opposite: `!x` is turned<n>(!x), and `a && b` is turned<n>(turned<n>(a) &&
/// turned<n>(b)), which is a || b where the mutant is on, and evaluates b only if it has to.
template <int n, class T>
[[gnu::always_inline]] constexpr bool turned(T&& value) {
  if (!std::is_constant_evaluated() && on<n>()) return !static_cast<bool>(std::forward<T>(value));
  return static_cast<bool>(std::forward<T>(value));
}

}  // namespace fathom_mutant
