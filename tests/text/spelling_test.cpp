#include <zlg/text/spelling.hpp>

#include "test.hpp"

namespace {

using zlg::text::letters_apart;

TEST(LettersApart, counts_insertions_deletions_and_replacements) {
    EXPECT_EQ(letters_apart("interval_s", "interval_s"), 0u);
    EXPECT_EQ(letters_apart("intervall_s", "interval_s"), 1u);
    EXPECT_EQ(letters_apart("kitten", "sitting"), 3u);
    EXPECT_EQ(letters_apart("", "run"), 3u);
    EXPECT_EQ(letters_apart("run", ""), 3u);
}

TEST(LettersApart, is_symmetric) { EXPECT_EQ(letters_apart("flaw", "lawn"), letters_apart("lawn", "flaw")); }

TEST(LowerCase, changes_the_letters_a_to_z_alone) { EXPECT_EQ(zlg::text::lower_case("aZ_9 µÄ"), "az_9 µÄ"); }

TEST(SmallLetters, of_three_alphabets) {
    EXPECT_EQ(zlg::text::small_letters("aZ_9 \u00b5\u00c4\u00d7\u00df"), "az_9 \u00b5\u00e4\u00d7\u00df");
    EXPECT_EQ(zlg::text::small_letters("\u0412\u0420\u0415\u041c\u042f, \u0441"),
              "\u0432\u0440\u0435\u043c\u044f, \u0441");
}

}  // namespace
