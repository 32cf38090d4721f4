
#include <zlg/config/schema.hpp>
#include <zlg/study/resolved.hpp>

#include "test.hpp"

namespace zlg::resolved_test {

TEST(Resolved, leaves_alone_what_leaves_nothing_open) {
    const study::Resolved made = study::resolved({});
    EXPECT_EQ(config::to_toml(made.config), config::to_toml({}));
    EXPECT_TRUE(made.notes.empty());
    EXPECT_TRUE(made.warnings.empty());
}

TEST(Resolved, puts_a_number_in_place_of_optimal_and_says_which) {
    config::Config c;
    c.motion.kind = config::MotionKind::rest;
    c.switching.interval_optimal = true;
    config::apply_set(c, "design.switch_error_arcsec=2");
    const study::Resolved made = study::resolved(c);
    EXPECT_FALSE(made.config.switching.interval_optimal);
    ASSERT_EQ(made.notes.size(), 1u);
    EXPECT_NE(made.notes[0].find("2 arcsec a switch, as design.switch_error_arcsec says"), std::string::npos);
}

// A loop so slow that its switches would take hours has no trial.
TEST(Resolved, says_where_the_error_of_a_switch_comes_from) {
    config::Config c;
    c.motion.kind = config::MotionKind::rest;
    c.switching.interval_optimal = true;
    EXPECT_NE(study::resolved(c).notes[0].find("arcsec a switch, as tried on the twin"), std::string::npos);
    c.perimeter.tau_s = 1.0;
    const study::Resolved made = study::resolved(c);
    ASSERT_EQ(made.notes.size(), 1u);
    EXPECT_NE(made.notes[0].find("10 arcsec a switch, the default of design.switch_error_arcsec, for fewer than 4"),
              std::string::npos)
        << made.notes[0];
}

TEST(Resolved, says_that_an_estimate_of_the_drift_is_not_foreseen) {
    config::Config c;
    c.motion.kind = config::MotionKind::rest;
    c.switching.interval_optimal = true;
    config::apply_set(c, "design.switch_error_arcsec=2");
    EXPECT_EQ(study::resolved(c).notes[0].find("estimate"), std::string::npos);
    c.compensation.magnetic = core::MagneticMethod::estimate;
    EXPECT_NE(study::resolved(c).notes[0].find("compensation.magnetic = \"estimate\" takes out is not foreseen"),
              std::string::npos);
}

TEST(Resolved, warns_of_a_motion_file_whose_last_line_has_no_end) {
    config::Config c;
    c.motion.kind = config::MotionKind::file;
    c.motion.path = (std::filesystem::path{testing::TempDir()} / "zlg_resolved_motion.txt").string();
    const auto warnings_of = [&c](const char* text) {
        std::ofstream{c.motion.path} << text;
        return study::resolved(c).warnings;
    };
    EXPECT_TRUE(warnings_of("0.5\n1.523\n").empty());
    const auto warnings = warnings_of("0.5\n1.5");
    std::filesystem::remove(c.motion.path);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0], c.motion.path + ": the last line has no end; the file may have been cut off");
}

TEST(Resolved, takes_the_constants_of_a_laser) {
    config::Config c;
    c.gyro.fidelity = config::Fidelity::laser;
    const study::Resolved made = study::resolved(c);
    EXPECT_FALSE(made.config.perimeter.discriminator_signal.empty());
    EXPECT_EQ(made.notes.size(), 1u);
}

}  // namespace zlg::resolved_test
