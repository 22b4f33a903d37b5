#include <fathom/threads/threads.h>

#include <atomic>

bool use_threads() {
  std::atomic<int> sum = 0;
  fathom::with_threads(2, [&] { fathom::parallel_for(1, 5, [&](int i) { sum += i; }); });
  return sum == 10;
}
