#pragma once

#include "apps/bench/bench_arguments.h"
#include "apps/shell/console.h"

namespace fathom::app {

/// `fathom bench --parts`: what each idea brings.
/// Fails    InputError where a scene cannot be read; bench::WrongPicture where an idea changes the
///          picture.
int run_parts(const BenchArguments& arguments, const Console& console);

}  // namespace fathom::app
