#include <zlg/firmware/exchange.hpp>

#include "test.hpp"

namespace zlg::firmware::exchange_test {

TEST(Exchange, begins_with_what_tells_the_processor_that_a_host_is_there) {
    // The processor looks at the first word of the memory before it knows anything else.
    EXPECT_EQ(offsetof(Exchange, magic), 0u);
    EXPECT_NE(lock_step_magic, 0u) << "memory without a host holds zeros";
}

TEST(Exchange, asks_nothing_at_first) {
    const Exchange exchange;
    EXPECT_EQ(exchange.magic, 0u);
    EXPECT_EQ(exchange.asked.load(), exchange.answered.load());
    EXPECT_EQ(exchange.readiness.load(), static_cast<std::uint32_t>(Readiness::absent));
}

TEST(Exchange, fits_the_memory_that_is_shared) { EXPECT_LT(sizeof(Exchange), 16u << 20); }

TEST(Exchange, has_no_layout_that_empty_memory_could_claim) { EXPECT_NE(layout(), 0u); }

}  // namespace zlg::firmware::exchange_test
