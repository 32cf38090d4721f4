#include <zlg/design/error.hpp>

#include "test.hpp"

namespace zlg::design::error_test {

TEST(DesignError, IsCaughtAsAnInvalidArgumentWithItsMessage) {
    const char* text = "run_s is 0, allowed is a finite number above 0";
    EXPECT_EQ(test::message_of<std::invalid_argument>([&] { throw DesignError(text); }), text);
}

}  // namespace zlg::design::error_test
