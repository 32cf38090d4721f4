#include <zlg/twin/motion.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace zlg::twin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// A text file that lives as long as the test.
class TextFile {
public:
    explicit TextFile(const std::string& text) {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        path_ =
            (std::filesystem::path{testing::TempDir()} / (std::string{"zlg_motion_"} + test->name() + ".txt")).string();
        std::ofstream{path_, std::ios::binary} << text;
    }
    TextFile(const TextFile&) = delete;
    TextFile& operator=(const TextFile&) = delete;
    ~TextFile() { std::filesystem::remove(path_); }
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
};

MotionFile motion_file(const std::string& path, int column = 1) {
    MotionFile file;
    file.path = path;
    file.column = column;
    return file;
}

std::string refusal(const MotionFile& file) {
    try {
        (void)Motion::from_file(file);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "accepted";
}

void expect_names(const std::string& message, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) {
        EXPECT_NE(message.find(part), std::string::npos) << "'" << message << "' does not name " << part;
    }
}

TEST(Motion, ARestingCaseDoesNotTurn) {
    EXPECT_EQ(Motion::rest().increment_arcsec(0.0, 1e6), 0.0);
    EXPECT_EQ(Motion::rest().duration_s(), infinity);
}

TEST(Motion, IncrementsOfASineAddUpToTheAnalyticAngle) {
    const Motion motion = Motion::sines(15.0, {{12000.0, 7.03, 30.0}});
    double sum = 0.0;
    for (int k = 0; k < 40000; ++k) sum += motion.increment_arcsec(k * 0.0025, (k + 1) * 0.0025);
    const double w = 2.0 * pi * 7.03;
    const double expected = 15.0 * 100.0 + 12000.0 / w * (std::cos(pi / 6.0) - std::cos(w * 100.0 + pi / 6.0));
    EXPECT_NEAR(sum, expected, 1e-7);
}

TEST(Motion, SeveralSinesAddAndZeroFrequencyIsAConstantRate) {
    const Motion motion = Motion::sines(0.0, {{100.0, 0.0, 90.0}, {50.0, 1.0, 0.0}});
    EXPECT_NEAR(motion.increment_arcsec(0.0, 0.5), 100.0 * 0.5 + 50.0 / (2.0 * pi) * 2.0, 1e-12);
}

TEST(Motion, AShortIncrementOfASineAfterAMonthIsStillRight) {
    // A whole number of periods, so that the phase is that of the start.
    const double month_s = 2592000.0;
    const Motion motion = Motion::sines(0.0, {{12000.0, 8.0, 0.0}});
    const double first = motion.increment_arcsec(0.0, 0.0625);
    EXPECT_NEAR(motion.increment_arcsec(month_s, month_s + 0.0625), first, 1e-4);
}

TEST(Motion, SampledMotionConservesTheAngleAtEveryRowBorder) {
    std::vector<double> rows;
    for (int k = 0; k < 500; ++k) rows.push_back(100.0 * std::sin(12.9898 * k * k));
    const Motion motion = Motion::from_increments(rows, 100.0);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const double t0_s = static_cast<double>(k) / 100.0;
        const double t1_s = static_cast<double>(k + 1) / 100.0;
        ASSERT_NEAR(motion.increment_arcsec(t0_s, t1_s), rows[k], 1e-9) << "row " << k;
        const double parts =
            motion.increment_arcsec(t0_s, t0_s + 0.0025) + motion.increment_arcsec(t0_s + 0.0025, t1_s);
        ASSERT_NEAR(parts, rows[k], 1e-9) << "row " << k;
    }
    double all = 0.0;
    for (const double row : rows) all += row;
    EXPECT_NEAR(motion.increment_arcsec(0.0, 5.0), all, 1e-9);
    EXPECT_NEAR(motion.increment_arcsec(5.0, 0.0), -all, 1e-9);
}

TEST(Motion, SampledMotionIsExactOnAConstantRateFromTheFirstRowToTheLast) {
    const Motion motion = Motion::from_increments({8.0, 8.0, 8.0}, 100.0);
    for (int k = 0; k < 12; ++k) {
        EXPECT_NEAR(motion.increment_arcsec(k * 0.0025, (k + 1) * 0.0025), 2.0, 1e-12) << "quarter row " << k;
    }
}

TEST(Motion, SampledMotionIsExactOnConstantAcceleration) {
    // theta = t^2 in rows: increments 1, 3, 5, ...; inside, away from the ends.
    const Motion motion = Motion::from_increments({1.0, 3.0, 5.0, 7.0, 9.0}, 1.0);
    EXPECT_NEAR(motion.increment_arcsec(2.25, 2.75), 2.75 * 2.75 - 2.25 * 2.25, 1e-12);
}

TEST(Motion, TheRateOfSampledMotionIsContinuousAcrossRows) {
    const Motion motion = Motion::from_increments({1.0, -4.0, 7.0, 2.0, -3.0}, 1.0);
    for (const double border_s : {1.0, 2.0, 3.0, 4.0}) {
        const double before = motion.increment_arcsec(border_s - 1e-6, border_s) / 1e-6;
        const double after = motion.increment_arcsec(border_s, border_s + 1e-6) / 1e-6;
        EXPECT_NEAR(before, after, 1e-3) << "border at " << border_s;
    }
}

TEST(Motion, BeyondTheEndOfSampledMotionTheCaseRests) {
    const Motion motion = Motion::from_increments({1.0, 2.0, 4.0}, 10.0);
    EXPECT_DOUBLE_EQ(motion.duration_s(), 0.3);
    EXPECT_NEAR(motion.increment_arcsec(0.2, 5.0), 4.0, 1e-12);
    EXPECT_EQ(motion.increment_arcsec(0.4, 5.0), 0.0);
    EXPECT_EQ(motion.increment_arcsec(-2.0, -1.0), 0.0);
}

TEST(Motion, HoursOfFastRotationTakeNoDigitsFromAnIncrement) {
    // 400 deg/s in rows of 10 ms for four hours: the angle is 2e10 arcsec, of which a double keeps 4e-6.
    const Motion motion = Motion::from_increments(std::vector<double>(1440000, 14400.0), 100.0);
    EXPECT_NEAR(motion.increment_arcsec(14399.5, 14399.5 + 0.0078125), 14400.0 * 0.78125, 2e-6);
    EXPECT_NEAR(motion.increment_arcsec(14399.5, 14399.51), 14400.0, 2e-6);
}

TEST(Motion, NumbersThatAreNotFiniteAreRefused) {
    EXPECT_THROW((void)Motion::sines(nan, {}), std::invalid_argument);
    EXPECT_THROW((void)Motion::sines(0.0, {{1.0, infinity, 0.0}}), std::invalid_argument);
    EXPECT_THROW((void)Motion::from_increments({1.0, nan}, 100.0), std::invalid_argument);
    EXPECT_THROW((void)Motion::from_increments({}, 100.0), std::invalid_argument);
    EXPECT_THROW((void)Motion::from_increments({1.0}, 0.0), std::invalid_argument);
    EXPECT_THROW((void)Motion::from_increments({1.0}, nan), std::invalid_argument);
}

TEST(MotionFile, AnySeparatorCommentsAndHeaderLinesAreUnderstood) {
    const TextFile text{
        "% made by hand\n\nheader of words\n1 2 3\n  % indented\n 10, 20 ,30\r\n11;21;31\n12\t 22 \t32\n+13,,33\n\n14 "
        ", 2.4e1;34"};
    MotionFile file = motion_file(text.path(), 3);
    file.comment = "%";
    file.skip_lines = 2;
    file.scale_arcsec = 0.1;
    file.rate_hz = 1.0;
    const Motion motion = Motion::from_file(file);
    EXPECT_EQ(motion.duration_s(), 5.0);
    for (int k = 0; k < 5; ++k) EXPECT_NEAR(motion.increment_arcsec(k, k + 1), 3.0 + 0.1 * k, 1e-12) << "row " << k;
    file.column = 1;
    EXPECT_NEAR(Motion::from_file(file).increment_arcsec(3.0, 4.0), 1.3, 1e-12) << "a plus sign is part of a number";
}

TEST(MotionFile, ARateIsDividedByTheRowsPerSecond) {
    const TextFile text{"50\n50\n"};
    MotionFile file = motion_file(text.path());
    file.holds_rate = true;
    file.scale_arcsec = 2.0;
    file.rate_hz = 200.0;
    EXPECT_NEAR(Motion::from_file(file).increment_arcsec(0.0, 0.01), 2.0 * 50.0 * 0.01, 1e-12);
}

TEST(MotionFile, AMissingFileADirectoryAndAnEmptyFileAreNamed) {
    expect_names(refusal(motion_file("/nowhere/at/all.txt")), {"/nowhere/at/all.txt"});
    expect_names(refusal(motion_file(testing::TempDir())), {"directory"});
    const TextFile text{"# only a comment\n\n"};
    expect_names(refusal(motion_file(text.path())), {text.path(), "0 rows"});
}

TEST(MotionFile, AMissingColumnIsNamedByLineAndColumn) {
    const TextFile text{"# x y\n1 2\n3\n"};
    expect_names(refusal(motion_file(text.path(), 2)), {text.path(), "line 3, column 2", "1..1"});
}

TEST(MotionFile, WhatIsNotAFiniteNumberIsNamedByLineColumnAndText) {
    for (const std::string bad : {"nan", "inf", "1e999", "1.5x", "abc", "--3", "+-3", "0x10"}) {
        const TextFile text{"1 1\n2 " + bad + "\n"};
        expect_names(refusal(motion_file(text.path(), 2)), {"line 2, column 2", "'" + bad + "'", "finite number"});
    }
    const TextFile text{"1,,3\n"};
    expect_names(refusal(motion_file(text.path(), 2)), {"line 1, column 2: ''"});
}

TEST(MotionFile, SettingsOutOfRangeAreRefused) {
    const TextFile text{"1\n"};
    const auto refused = [&](auto change) {
        MotionFile file = motion_file(text.path());
        change(file);
        EXPECT_THROW((void)Motion::from_file(file), std::invalid_argument);
    };
    refused([](MotionFile& f) { f.column = 0; });
    refused([](MotionFile& f) { f.scale_arcsec = nan; });
    refused([](MotionFile& f) { f.rate_hz = -1.0; });
    refused([](MotionFile& f) { f.skip_lines = -1; });
}

// A real laser-gyro unit on the ground: what its three gyros see together is the rotation of the Earth.
TEST(MotionFile, ARealLogLoadsAndShowsTheEarth) {
    const std::filesystem::path path = std::filesystem::path{ZLG_SHARED_DIR} / "data" / "lasergyro.imu";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the recorded log " << path << " is not on this machine";
    double sum_sq = 0.0;
    for (int column = 1; column <= 3; ++column) {
        MotionFile file = motion_file(path.string(), column);
        file.comment = "%";
        file.skip_lines = 3;
        file.scale_arcsec = 0.1;
        file.rate_hz = 100.0;
        const Motion motion = Motion::from_file(file);
        EXPECT_EQ(std::llround(motion.duration_s() * 100.0), 184718);
        const double rate = motion.increment_arcsec(0.0, motion.duration_s()) / motion.duration_s();
        sum_sq += rate * rate;
    }
    EXPECT_NEAR(std::sqrt(sum_sq), 14.86, 0.01);
}

}  // namespace
}  // namespace zlg::twin
