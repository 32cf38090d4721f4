#include <zlg/design/error.hpp>

#include "test.hpp"

namespace zlg::design {
namespace {

TEST(DesignError, IsCaughtAsAnInvalidArgumentWithItsMessage) {
    try {
        throw DesignError("run_s is 0, allowed is a finite number above 0");
    } catch (const std::invalid_argument& error) {
        EXPECT_EQ(std::string{error.what()}, "run_s is 0, allowed is a finite number above 0");
    }
}

}  // namespace
}  // namespace zlg::design
