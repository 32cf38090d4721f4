#include <zlg/recorded/motion.hpp>

#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace zlg::motion_test {

TEST(RecordedMotion, a_file_turns_the_gyro_by_its_rows) {
    const std::string path = (std::filesystem::path{testing::TempDir()} / "zlg_recorded_motion.txt").string();
    std::ofstream{path} << "0.5\n1.5\n";
    config::Config c;
    c.motion.kind = config::MotionKind::file;
    c.motion.path = path;
    c.motion.rate_hz = 4.0;
    const twin::Motion motion = recorded::motion(c);
    std::filesystem::remove(path);
    EXPECT_EQ(motion.duration_s(), 0.5);
    EXPECT_NEAR(motion.increment_arcsec(0.0, 0.5), 2.0, 1e-12);
}

TEST(RecordedMotion, other_kinds_are_those_of_the_rig) {
    config::Config c;
    c.motion.kind = config::MotionKind::constant;
    c.motion.rate_arcsec_s = 30.0;
    EXPECT_EQ(recorded::motion(c).increment_arcsec(1.0, 3.0), rig::motion(c).increment_arcsec(1.0, 3.0));
    EXPECT_NEAR(recorded::motion(c).increment_arcsec(1.0, 3.0), 60.0, 1e-12);
}

}  // namespace zlg::motion_test
