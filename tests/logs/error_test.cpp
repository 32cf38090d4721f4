#include <zlg/logs/error.hpp>

#include "test.hpp"

using namespace zlg::logs;

TEST(Error, tells_bad_content_from_a_bad_file) {
    EXPECT_FALSE((std::is_base_of_v<IoError, FormatError>));
    EXPECT_FALSE((std::is_base_of_v<FormatError, IoError>));
}

TEST(Error, both_can_be_caught_as_runtime_error_with_their_message) {
    EXPECT_STREQ(static_cast<const std::runtime_error&>(FormatError("row 3")).what(), "row 3");
    EXPECT_STREQ(static_cast<const std::runtime_error&>(IoError("no disk")).what(), "no disk");
}
