#include <zlg/recorded/motion.hpp>

#include <zlg/config/schema.hpp>

#include "test.hpp"

namespace zlg::recorded::text_layout_test {

TEST(TextLayout, EachWordOfTheKeysIsTheOneOfTheReader) {
    using enum logs::TextSeparator;
    const auto layout = [](const std::string& key, const std::string& word) {
        config::Config config;
        config::apply_pair(config, "motion." + key, word, "test");
        return text_layout(config.motion);
    };
    for (const auto& [word, separator] :
         {std::pair{"auto", automatic}, std::pair{"space", blanks}, std::pair{"tab", tab},
          std::pair{"semicolon", semicolon}, std::pair{"comma", comma}, std::pair{"bar", bar}})
        EXPECT_EQ(layout("separator", word).separator, separator) << word;
    for (const auto& [word, mark] :
         {std::pair{"auto", logs::TextMark::automatic}, std::pair{"point", logs::TextMark::point},
          std::pair{"comma", logs::TextMark::comma}})
        EXPECT_EQ(layout("decimal", word).mark, mark) << word;
    EXPECT_EQ(layout("comment", "%").comment, "%");
    EXPECT_EQ(layout("skip_lines", "3").skip_lines, 3);
    EXPECT_EQ(layout("time_column", "t").time_column, "t");
    EXPECT_EQ(layout("time_column", "t").section, "motion");
}

}  // namespace zlg::recorded::text_layout_test
