
#include <zlg/config/schema.hpp>
#include <zlg/study/how_made.hpp>

#include "test.hpp"

namespace zlg::how_made_test {

TEST(HowMade, defaults_need_no_lines) {
    EXPECT_EQ(study::own_settings({}), "");
    const auto section = study::how_made("run", {});
    EXPECT_EQ(section.code, "");
    EXPECT_NE(section.paragraphs.at(0).find("defaults"), std::string::npos);
}

TEST(HowMade, its_lines_read_back_to_the_same_configuration) {
    config::Config asked;
    for (const char* setting : {"run.seed=9", "motion.kind=sine", "faults.kind=[\"laser_off\"]", "faults.at_s=[1.5]",
                                "faults.duration_s=[0.25]", "faults.size=[0]", "compensation.bridge=linear"})
        config::apply_set(asked, setting);
    config::Config again;
    config::apply_toml(again, study::how_made("run", asked).code, "made.toml");
    EXPECT_EQ(config::to_toml(again), config::to_toml(asked));
}

TEST(HowMade, of_files_the_command_and_what_each_file_was) {
    config::Config asked;
    config::apply_set(asked, "analysis.confidence=0.9");
    const std::string code = study::how_made("zlg analyze w.csv", {"w.csv: 3 bytes"}, "axis = [\"2\"]\n", asked).code;
    for (const char* part :
         {"zlg analyze w.csv\n# w.csv: 3 bytes\n", "\naxis = [\"2\"]\n", "analysis.confidence = 0.9\n"})
        test::expect_contains(code, part);
}

}  // namespace zlg::how_made_test
