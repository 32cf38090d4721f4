#include <zlg/sweep/description_table.hpp>

#include "test.hpp"

namespace zlg::sweep::description_table_test {

const toml::table& document() {
    static const toml::table made = parse_document(
        "[a]\nx = 2\ny = \"text\"\n\n[[drawn]]\nkeys = [\"gyro.scale_arcsec\"]\n"
        "draw = \"list\"\nvalues = [1.0, 2.0]\n",
        "d.toml");
    return made;
}

TEST(DescriptionTable, values_come_with_the_place_that_a_complaint_names) {
    const Table table{"d.toml", "a", *document().get("a")->as_table()};
    EXPECT_EQ(table.real("x"), 2.0);
    EXPECT_EQ(table.integer("x", 0, 3), 2);
    EXPECT_EQ(table.text("y"), "text");
    try {
        (void)table.real("y");
        FAIL();
    } catch (const config::ConfigError& error) {
        EXPECT_STREQ(error.what(), "d.toml:3: [a] y = \"text\": allowed is a finite number");
    }
    EXPECT_THROW(table.allow_only({"x"}), config::ConfigError);
}

TEST(DescriptionTable, what_is_drawn_may_have_another_name_than_parameter) {
    const Table root{"d.toml", "root", document()};
    const std::vector<Parameter> drawn = read_parameters(root, "drawn", {});
    ASSERT_EQ(drawn.size(), 1u);
    EXPECT_EQ(drawn[0].keys, std::vector<std::string>{"gyro.scale_arcsec"});
    EXPECT_EQ(drawn[0].values.size(), 2u);
    EXPECT_TRUE(read_parameters(root, "nothing", {}).empty());
}

TEST(DescriptionTable, a_text_that_is_no_toml_is_named_by_line_and_column) {
    try {
        (void)parse_document("[a\n", "d.toml");
        FAIL();
    } catch (const config::ConfigError& error) {
        EXPECT_EQ(std::string{error.what()}.find("d.toml:1:"), 0u) << error.what();
    }
}

}  // namespace zlg::sweep::description_table_test
