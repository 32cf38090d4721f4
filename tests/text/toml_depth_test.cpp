#include <zlg/text/toml_depth.hpp>

#include <rapidcheck/gtest.h>
#include <toml++/toml.h>

#include "test.hpp"

namespace zlg::text::toml_depth_test {

std::string repeated(std::string_view piece, int n) {
    std::string text;
    for (int k = 0; k < n; ++k) text += piece;
    return text;
}

TEST(TomlDepth, EveryWayToNestIsFound) {
    const std::string dots = repeated("x.", 30000) + "y";
    EXPECT_TRUE(too_deep(dots + " = 1\n"));
    EXPECT_TRUE(too_deep("[" + dots + "]\na = 1\n"));
    EXPECT_TRUE(too_deep("[[" + dots + "]]\na = 1\n"));
    EXPECT_TRUE(too_deep("a = " + repeated("[", 30000)));
    EXPECT_TRUE(too_deep("a = " + repeated("[\n", 30000)));
    EXPECT_TRUE(too_deep("a = " + repeated("{b = ", 30000)));
    EXPECT_TRUE(too_deep("a = {b = 1, " + dots + " = 1}"));
    EXPECT_TRUE(too_deep("a = " + repeated("{b.c.d.e.f.g.h.i = [", 10)));
    EXPECT_TRUE(too_deep("[" + repeated("x.", 40) + "y]\n" + repeated("x.", 40) + "y = 1\n"));
    EXPECT_TRUE(too_deep(repeated("\"x\" . ", 100) + "y = 1\n"));
}

TEST(TomlDepth, WidthLengthAndStringsAreNoDepth) {
    EXPECT_FALSE(too_deep("a = [" + repeated("1.5, ", 100000) + "]"));
    EXPECT_FALSE(too_deep(repeated("[a.b]\n", 1000)));
    EXPECT_FALSE(too_deep(repeated("a = [[1.0, 2.0], {b.c = 1}]\n", 1000)));
    EXPECT_FALSE(too_deep("a = \"" + repeated("[.{", 1000) + "\"\nb = '" + repeated("[.{", 1000) + "'\n"));
    EXPECT_FALSE(too_deep("a = \"\"\"\n" + repeated("[.{\n", 1000) + "\\\"\"\"\"\"\n"));
    EXPECT_FALSE(too_deep("a = '''\n" + repeated("[.{\n", 1000) + "'''\n"));
    EXPECT_FALSE(too_deep("# " + repeated("[.{", 1000) + "\na = 1 # " + repeated("x.", 1000)));
    EXPECT_FALSE(too_deep(""));
}

TEST(TomlDepth, StringsThatTheScannerEndsAreThoseThatTomlEnds) {
    for (const char* value : {R"("a\"b")", R"("""a""b""")", R"("""a"""")", R"("""a""""")", "'a\\'", "'''a''b'''"}) {
        const std::string line = std::string{"a = "} + value + "\n";
        ASSERT_NO_THROW((void)toml::parse(line)) << line;
        EXPECT_TRUE(too_deep(line + repeated("x.", 100) + "y = 1\n")) << line;
    }
}

TEST(TomlDepth, SaysWhere) {
    const auto place = too_deep("a = 1\n\nb = " + repeated("[", 100));
    ASSERT_TRUE(place);
    EXPECT_EQ(place->line, 3u);
    EXPECT_NEAR(place->column, 4 + max_toml_levels, 2);
}

int depth(const toml::node& node) {
    int most = 0;
    if (const toml::table* table = node.as_table())
        for (const auto& [key, value] : *table) most = std::max(most, 1 + depth(value));
    if (const toml::array* array = node.as_array())
        for (const toml::node& value : *array) most = std::max(most, 1 + depth(value));
    return most;
}

// Whatever the scanner lets pass makes no deep tree.
RC_GTEST_PROP(TomlDepth, WhatPassesIsNoDeepTree, ()) {
    const auto pieces = *rc::gen::container<std::vector<std::string>>(
        rc::gen::elementOf(std::vector<std::string>{"x.y.z.", "x", "y = ", "{", "}", "[", "]", ",", "\n", "1", "\"",
                                                    "'", "#", "\\", "\"\"\"", "x.x.x.x.x.x.x.x.x.x.x = [{"}));
    std::string text;
    for (const std::string& piece : pieces) text += piece;
    if (too_deep(text)) return;
    try {
        RC_ASSERT(depth(toml::parse(text)) <= 2 * max_toml_levels);
    } catch (const toml::parse_error&) {
        // Nor does it matter for what is no TOML.
    }
}

}  // namespace zlg::text::toml_depth_test
