#include <zlg/text/toml_document.hpp>

#include <string>

#include <gtest/gtest.h>

namespace zlg::text {
namespace {

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
        EXPECT_NE(std::string{error.description()}.find("64"), std::string::npos);
    }
}

}  // namespace
}  // namespace zlg::text
