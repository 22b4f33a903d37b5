// fathom scan: small cases that would cost much.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "small_cost.h"

namespace fathom::test {
namespace {}  // namespace
}  // namespace fathom::test
