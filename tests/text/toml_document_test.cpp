#include <zlg/text/toml_document.hpp>

#include "test.hpp"

namespace zlg::text::toml_document_test {

TEST(TomlDocument, IsWhatTheParserMakesOfIt) {
    const toml::table document = parse_toml("[gyro]\ntick_s = 0.01\n");
    EXPECT_EQ(document["gyro"]["tick_s"].value<double>(), 0.01);
}

TEST(TomlDocument, ADeepKeyIsRefusedAtItsPlace) {
    std::string key;
    for (int k = 0; k < 30000; ++k) key += "x.";
    try {
        (void)parse_toml("a = 1\n" + key + "y = 1\n");
        FAIL() << "no refusal";
    } catch (const toml::parse_error& error) {
        EXPECT_EQ(error.source().begin.line, 2u);
        test::expect_contains(std::string{error.description()}, "64");
    }
}

}  // namespace zlg::text::toml_document_test
