#include <zlg/logs/mapping.hpp>

#include "temporary_folder.hpp"

namespace zlg::logs::mapping_test {

std::string refusal(const std::string& pair) {
    Mapping mapping;
    return test::refusal_by<MappingError>([&] { apply_mapping_pair(mapping, pair); });
}

TEST(Mapping, says_what_a_key_takes) {
    test::expect_contains(refusal("holds=speed"), "rate|increment|angle");
    test::expect_contains(refusal("unit=deg/fortnight"), "deg/h");
    test::expect_contains(refusal("unti=deg/h"), "'unit'");
    test::expect_contains(refusal("tick_s=-1"), "above 0");
    test::expect_contains(refusal("tick_s=nan"), "above 0");
    test::expect_contains(refusal("holds=rate|increment"), "allowed");
    test::expect_contains(refusal("mode=always:plus"), "always:VALUE");
    test::expect_contains(refusal("unit"), "key=value");
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

}  // namespace zlg::logs::mapping_test
