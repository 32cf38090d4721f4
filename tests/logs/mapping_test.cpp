#include <zlg/logs/mapping.hpp>

#include <gtest/gtest.h>

#include "temporary_folder.hpp"

namespace zlg::logs {
namespace {

std::string refusal(const std::string& pair) {
    Mapping mapping;
    try {
        apply_mapping_pair(mapping, pair);
    } catch (const MappingError& error) {
        return error.what();
    }
    return {};
}

TEST(Mapping, says_what_a_key_takes) {
    EXPECT_NE(refusal("holds=speed").find("rate|increment|angle"), std::string::npos);
    EXPECT_NE(refusal("unit=deg/fortnight").find("deg/h"), std::string::npos);
    EXPECT_NE(refusal("unti=deg/h").find("'unit'"), std::string::npos);
    EXPECT_NE(refusal("tick_s=-1").find("above 0"), std::string::npos);
    EXPECT_NE(refusal("tick_s=nan").find("above 0"), std::string::npos);
    EXPECT_NE(refusal("holds=rate|increment").find("allowed"), std::string::npos);
    EXPECT_NE(refusal("mode=always:plus").find("always:VALUE"), std::string::npos);
    EXPECT_NE(refusal("unit").find("key=value"), std::string::npos);
    EXPECT_EQ(refusal("mode=always:-1"), "");
    EXPECT_EQ(refusal("unit=\xC2\xB0/h"), "");
}

TEST(Mapping, what_is_written_as_toml_reads_back) {
    Mapping mapping;
    for (const char* pair :
         {"tick_s=0.005", "unit=deg/h", "time=Zeit [s]", "comment=\"", "axis=[\"w, x\", 3]", "mode_plus=-1"})
        apply_mapping_pair(mapping, pair);
    const test::TemporaryFolder folder;
    Mapping back;
    apply_mapping_file(back, folder.write("mapping.toml", mapping.toml()));
    EXPECT_EQ(back.toml(), mapping.toml());
    EXPECT_EQ(back.axes(), (std::vector<std::string>{"w, x", "3"}));
    EXPECT_EQ(back.real("tick_s"), 0.005);
    EXPECT_EQ(back.text("comment"), "\"");
    EXPECT_FALSE(back.has("holds"));
}

}  // namespace
}  // namespace zlg::logs
