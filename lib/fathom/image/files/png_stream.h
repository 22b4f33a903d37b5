#pragma once

#include <png.h>

#include "fathom/text/file_bytes.h"

/// libpng without longjmp over C++ objects: whoever calls libpng keeps everything with a destructor
/// in a struct outside the function that calls setjmp.
namespace fathom::image {

/// libpng's message when it gives up; libpng then jumps back to setjmp.
struct PngFailure {
  char reason[160] = "";
};
[[noreturn]] void png_fail(png_structp png, png_const_charp reason);
void png_ignore_warning(png_structp png, png_const_charp reason);

}  // namespace fathom::image
