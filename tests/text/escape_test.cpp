#include <zlg/text/escape.hpp>

#include <rapidcheck/gtest.h>

#include "test.hpp"

namespace zlg::text::escape_test {

TEST(Escape, ControlCharactersAreShown) {
    EXPECT_EQ(escaped("a\x1b[31mb"), "a\\u001B[31mb");
    EXPECT_EQ(escaped("a\nb\tc\rd"), "a\\u000Ab\\u0009c\\u000Dd");
    EXPECT_EQ(escaped("a\nb\tc", Lines::many), "a\nb\\u0009c");
    EXPECT_EQ(escaped(std::string_view{"\0", 1}), "\\u0000");
    EXPECT_EQ(escaped("\x7f"), "\\u007F");
    EXPECT_EQ(escaped("\u0085 \u2028 \u202e"), "\\u0085 \\u2028 \\u202E");
}

TEST(Escape, OtherLettersStayAsTheyAre) { EXPECT_EQ(escaped("\"a\\b\" грат µ 𝄞"), "\"a\\b\" грат µ 𝄞"); }

TEST(Escape, BytesThatAreNoTextAreShown) {
    EXPECT_EQ(escaped("a\xff\xc3"), "a\\u00FF\\u00C3");
    EXPECT_EQ(escaped("\xc0\x80"), "\\u00C0\\u0080");
    EXPECT_EQ(escaped("\xed\xa0\x80"), "\\u00ED\\u00A0\\u0080");
}

TEST(Escape, TextThatIsNoUtf8IsTakenForLatin1) {
    EXPECT_EQ(as_utf8("wx [\xB0/h]"), "wx [\xC2\xB0/h]");
    EXPECT_EQ(as_utf8("\xFC\xB5"), "\xC3\xBC\xC2\xB5");
    EXPECT_EQ(as_utf8("wx [\xC2\xB0/h]"), "wx [\xC2\xB0/h]");
    EXPECT_EQ(as_utf8(""), "");
}

RC_GTEST_PROP(Escape, WhateverComesInIsOneLineWithoutControlCharacters, (const std::string& text)) {
    for (const char c : escaped(text)) RC_ASSERT(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f);
    RC_ASSERT(escaped(escaped(text)) == escaped(text));
}

TEST(Escape, OnlyTheMiddleOfALongTextIsLost) {
    EXPECT_EQ(shortened("short"), "short");
    const std::string cut = shortened("begin" + std::string(100000, 'x') + "end", 1000);
    EXPECT_LE(cut.size(), 1000u);
    EXPECT_TRUE(cut.starts_with("beginx"));
    EXPECT_TRUE(cut.ends_with("xend"));
}

TEST(Escape, AnExcerptIsOneLineThatSaysWhetherItIsWhole) {
    EXPECT_EQ(excerpt("12\t\x7f"
                      "3\n",
                      6, '?'),
              "12??3?");
    EXPECT_EQ(excerpt("1234567", 6, ' '), "123456...");
    EXPECT_EQ(excerpt("", 6, ' '), "");
}

}  // namespace zlg::text::escape_test
