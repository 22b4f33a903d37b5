#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "validation/opengl/egl_context.h"

namespace fathom::validation {
namespace {

TEST(DemandedDriver, AnotherOneIsRefused) {
  EXPECT_NO_THROW(require(Driver::usual, "llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_NO_THROW(require(Driver::llvmpipe, "llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_NO_THROW(require(Driver::softpipe, "softpipe"));
  EXPECT_THROW(require(Driver::softpipe, "llvmpipe (LLVM 15.0.6, 256 bits)"), InputError);
  EXPECT_THROW(require(Driver::llvmpipe, ""), InputError);
}

}  // namespace
}  // namespace fathom::validation
