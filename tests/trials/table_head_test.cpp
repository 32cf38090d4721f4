#include <zlg/trials/table_head.hpp>

#include "test.hpp"

TEST(TableHead, IsOneRowOfNamesAndTheRuleBelow) {
    EXPECT_EQ(zlg::trials::table_head({"fault", "after, ms"}), "| fault | after, ms |\n|---|---|\n");
}
