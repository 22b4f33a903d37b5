// The library leaves TBB's settings to the program that it is part of; tests are such programs.
#include <tbb/global_control.h>

#include <algorithm>
#include <thread>

namespace {

const tbb::global_control more_threads(tbb::global_control::max_allowed_parallelism,
                                       std::max(16U, std::thread::hardware_concurrency()));

}  // namespace
