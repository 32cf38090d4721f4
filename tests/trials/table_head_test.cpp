#include <zlg/trials/table_head.hpp>

#include <gtest/gtest.h>

TEST(TableHead, IsOneRowOfNamesAndTheRuleBelow) {
    EXPECT_EQ(zlg::trials::table_head({"fault", "after, ms"}), "| fault | after, ms |\n|---|---|\n");
}
