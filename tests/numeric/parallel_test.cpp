#include <zlg/numeric/parallel.hpp>

#include "test.hpp"

namespace zlg::numeric::parallel_test {

TEST(InParallel, does_every_piece_once) {
    for (const int threads : {1, 2, 7, 200}) {
        std::vector<int> done(100, 0);
        in_parallel(100, threads, [&](std::size_t k) { ++done[k]; });
        EXPECT_EQ(done, std::vector<int>(100, 1)) << threads << " threads";
    }
}

TEST(InParallel, nothing_to_do) {
    in_parallel(0, 4, [](std::size_t) { FAIL(); });
}

TEST(InParallel, one_thread_is_the_callers_and_keeps_the_order) {
    std::vector<std::size_t> order;
    const std::thread::id me = std::this_thread::get_id();
    in_parallel(5, 1, [&](std::size_t k) {
        EXPECT_EQ(std::this_thread::get_id(), me);
        order.push_back(k);
    });
    EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

TEST(InParallel, throws_the_failure_of_the_lowest_index_on_any_number_of_threads) {
    for (const int threads : {1, 2, 8}) {
        for (int repeat = 0; repeat < 50; ++repeat) {
            std::vector<std::atomic<bool>> done(40);
            const std::string failure = test::refusal_by<std::runtime_error>([&] {
                in_parallel(40, threads, [&](std::size_t k) {
                    if (k == 11 || k == 12 || k == 30) throw std::runtime_error{std::to_string(k)};
                    done[k] = true;
                });
            });
            EXPECT_EQ(failure, "11") << threads << " threads";
            for (std::size_t k = 0; k < 11; ++k) EXPECT_TRUE(done[k]) << k;
        }
    }
}

}  // namespace zlg::numeric::parallel_test
