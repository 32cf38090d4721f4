#include <zlg/logs/budget.hpp>

#include <zlg/logs/error.hpp>

#include "test.hpp"

namespace zlg::logs::budget_test {

TEST(Budget, counts_all_arrays_of_a_file_together) {
    Budget budget{"a.h5", 1000};
    const std::size_t most = (std::size_t{1} << 20) + 4000;
    EXPECT_EQ(budget.max_values(), most);
    budget.take_values(most / 2, 1);
    budget.take_values(0, std::numeric_limits<std::size_t>::max());
    EXPECT_THROW(budget.take_values(most / 2 + 1, 1), FormatError);
    budget.take_values(most / 4, 2);
    EXPECT_THROW(budget.take_values(1, 1), FormatError);
}

TEST(Budget, a_product_that_overflows_is_too_much) {
    Budget budget{"a.h5", 1000};
    const std::size_t half = std::size_t{1} << 32;
    EXPECT_THROW(budget.take_values(half, half), FormatError);
    EXPECT_THROW(budget.take_values(2, half), FormatError);
    EXPECT_THROW(budget.take_values(half, 0), FormatError);
}

TEST(Budget, of_a_sparse_file_too) {
    EXPECT_LE(Budget("a.npy", std::numeric_limits<std::size_t>::max()).max_values(), std::size_t{1} << 30);
}

TEST(Budget, rows_that_are_filled_in_are_a_multiple_of_those_there) {
    EXPECT_EQ(max_missing_rows(60), 360'000);
    EXPECT_EQ(max_missing_rows(1'000'000), 10'000'000);
}

TEST(Budget, chunks_cost_more_than_their_values) {
    Budget budget{"a.h5", 0};
    budget.take_values(1 << 20, 1);
    budget.take_chunks(1 << 14, 0);
    budget.take_chunks(2, 1 << 20);
    EXPECT_THROW(budget.take_chunks(1, 128), FormatError);
    EXPECT_THROW(budget.take_chunks(std::numeric_limits<std::size_t>::max(), std::numeric_limits<std::size_t>::max()),
                 FormatError);
    EXPECT_THROW(Budget("a.h5", 0).take_chunks((1 << 15) + 1, 0), FormatError);
}

TEST(Budget, ten_thousand_objects_are_enough) {
    Budget budget{"a.h5", 1000};
    for (int k = 0; k < 10'000; ++k) budget.take_object();
    EXPECT_THROW(budget.take_object(), FormatError);
}

}  // namespace zlg::logs::budget_test
