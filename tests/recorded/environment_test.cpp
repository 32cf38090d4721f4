#include <zlg/recorded/environment.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/rig/wiring.hpp>

#include "temporary_folder.hpp"

namespace zlg::recorded_environment_test {

class RecordedEnvironment : public testing::Test {
protected:
    config::Config of(const std::string& text) {
        config::Config c;
        c.temperature.profile.path = folder_.write("chamber.txt", text);
        return recorded::with_environment(c);
    }

    test::TemporaryFolder folder_;
};

TEST_F(RecordedEnvironment, a_file_has_times_and_values) {
    const config::Config c = of("# chamber\n0 20\n600 -5.5\n1200 30\n");
    ASSERT_EQ(c.temperature.profile.points.size(), 3u);
    EXPECT_EQ(c.temperature.profile.points[1].at_s, 600.0);
    EXPECT_EQ(c.temperature.profile.points[1].value, -5.5);
    EXPECT_EQ(rig::twin_config(c).temperature.profile.points.size(), 3u);
    // Only the name goes into logs.
    for (const auto& [key, value] : config::to_settings(c))
        if (key == "temperature.profile") EXPECT_NE(value.find("chamber.txt"), std::string::npos);
}

TEST_F(RecordedEnvironment, points_that_are_no_course_are_refused_with_the_file) {
    for (const char* text : {"0 20\n", "0 20\n5 21\n5 22\n", "0 20\n5 21\n4 22\n", "0 20\n1 nan\n"}) {
        const std::string refusal = test::refusal_by<config::ConfigError>([&] { (void)of(text); });
        EXPECT_NE(refusal.find("chamber.txt"), std::string::npos) << text;
        EXPECT_NE(refusal.find("allowed"), std::string::npos) << text;
    }
}

TEST_F(RecordedEnvironment, a_file_that_was_not_read_makes_no_twin) {
    config::Config c;
    c.temperature.profile.path = "chamber.txt";
    EXPECT_THROW((void)rig::twin_config(c), config::ConfigError);
}

TEST_F(RecordedEnvironment, a_run_is_no_longer_than_its_field) {
    config::Config c;
    c.field.kind = config::FieldKind::file;
    c.field.course.path = folder_.write("field.txt", "0 0.5\n100 0.4\n");
    c = recorded::with_environment(c);
    c.run.duration_s = 100.0;
    EXPECT_EQ(rig::run_ticks(c, rig::motion(c)), 20'000);
    c.run.duration_s = 100.1;
    EXPECT_THROW((void)rig::run_ticks(c, rig::motion(c)), config::ConfigError);
}

}  // namespace zlg::recorded_environment_test
