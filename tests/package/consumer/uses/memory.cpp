#include <fathom/memory/available_memory.h>

bool use_memory() {
  return fathom::available_memory().bytes > 0 && fathom::size_in_words(2e9) == "2.0 GB";
}
