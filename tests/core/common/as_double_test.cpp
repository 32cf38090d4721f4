#include <zlg/core/common/as_double.hpp>

#include "support.hpp"

namespace zlg::core::as_double_test {

TEST(AsDouble, IsRoundedOnceLikeTheConversion) {
    for (const std::int64_t x : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{1} << 32, -(std::int64_t{1} << 32) - 1,
                                 (std::int64_t{1} << 53) + 1, -(std::int64_t{1} << 53) - 1, INT64_MAX, INT64_MIN})
        EXPECT_EQ(as_double(x), static_cast<double>(x)) << x;
}

}  // namespace zlg::core::as_double_test
