#include <zlg/text/toml_text.hpp>

#include <rapidcheck/gtest.h>

#include <zlg/text/toml_document.hpp>

#include "test.hpp"

namespace zlg::text::toml_text_test {

TEST(TomlText, AStringIsOneQuotedLine) {
    EXPECT_EQ(toml_string("optimal"), "\"optimal\"");
    EXPECT_EQ(toml_string("a\"b\\c\n\x7f"), "\"a\\\"b\\\\c\\u000A\\u007F\"");
}

RC_GTEST_PROP(TomlText, AStringReadsBackAsItWas, ()) {
    const auto written = *rc::gen::container<std::string>(rc::gen::inRange('\1', '\x7f'));
    RC_ASSERT(parse_toml("v = " + toml_string(written))["v"].value<std::string>() == written);
}

TEST(TomlText, ARealReadsBackToTheSameNumber) {
    EXPECT_EQ(toml_real(0.1), "0.1");
    EXPECT_EQ(toml_real(2.0), "2");
    EXPECT_EQ(toml_real(-0.0), "-0.0");
    EXPECT_TRUE(std::signbit(*parse_toml("v = " + toml_real(-0.0))["v"].value<double>()));
}

}  // namespace zlg::text::toml_text_test
