#include <gtest/gtest.h>

#include <zlg/config/spelling.hpp>

namespace {

using zlg::config::letters_apart;

TEST(LettersApart, counts_insertions_deletions_and_replacements) {
    EXPECT_EQ(letters_apart("interval_s", "interval_s"), 0u);
    EXPECT_EQ(letters_apart("intervall_s", "interval_s"), 1u);
    EXPECT_EQ(letters_apart("kitten", "sitting"), 3u);
    EXPECT_EQ(letters_apart("", "run"), 3u);
    EXPECT_EQ(letters_apart("run", ""), 3u);
}

TEST(LettersApart, is_symmetric) { EXPECT_EQ(letters_apart("flaw", "lawn"), letters_apart("lawn", "flaw")); }

}  // namespace
