#include <zlg/recorded/motion.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>

#include "test.hpp"

namespace zlg::recorded::motion_file_test {

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

config::Motion described(const std::string& path, const std::string& column = "") {
    config::Motion motion;
    motion.kind = config::MotionKind::file;
    motion.path = path;
    motion.column = column;
    motion.rate_hz = 1.0;
    return motion;
}

twin::Motion motion_of_file(const config::Motion& motion) {
    config::Config config;
    config.motion = motion;
    return recorded::motion(config);
}

std::string refusal(const config::Motion& motion) {
    try {
        (void)motion_of_file(motion);
    } catch (const logs::FormatError& error) {
        return error.what();
    } catch (const logs::IoError& error) {
        return error.what();
    } catch (const config::ConfigError& error) {
        return error.what();
    }
    return "accepted";
}

void expect_names(const std::string& message, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) {
        EXPECT_NE(message.find(part), std::string::npos) << "'" << message << "' does not name " << part;
    }
}

// The tables that text files of `analyze` are held against, in tests/logs/text_columns_test.cpp, need no repetition:
// there is one reader.
TEST(MotionFile, CommentsHeadersAndDecimalCommasAreUnderstood) {
    const TextFile text{
        "% made by hand\n\ntitle of words\na;b;c\n  % indented\n 1,0; 20 "
        ";30,0\r\n3,5;21;30,1\n2;22;30,2\n+3;-5,5;30,3\n\n14 "
        ";2,4e1;30,4"};
    config::Motion file = described(text.path(), "c");
    file.comment = "%";
    file.skip_lines = 1;
    file.scale_arcsec = 0.1;
    const twin::Motion motion = motion_of_file(file);
    EXPECT_EQ(motion.duration_s(), 5.0);
    for (int k = 0; k < 5; ++k) EXPECT_NEAR(motion.increment_arcsec(k, k + 1), 3.0 + 0.01 * k, 1e-12) << "row " << k;
    file.column = "1";
    EXPECT_NEAR(motion_of_file(file).increment_arcsec(3.0, 4.0), 0.3, 1e-12) << "a plus sign is part of a number";
}

TEST(MotionFile, WhatCanBeReadInTwoWaysIsRefusedWithTheKeysOfMotion) {
    const TextFile text{"0,5\n0,7\n"};
    expect_names(refusal(described(text.path())), {"can be read as", "motion.separator", "motion.decimal"});
    config::Motion file = described(text.path());
    file.decimal = config::DecimalMark::comma;
    EXPECT_NEAR(motion_of_file(file).increment_arcsec(0.0, 2.0), 1.2, 1e-12);
}

TEST(MotionFile, EachWordOfTheKeysIsTheOneOfTheReader) {
    for (const auto& [word, letter] : {std::pair{"space", ' '}, std::pair{"tab", '\t'}, std::pair{"semicolon", ';'},
                                       std::pair{"comma", ','}, std::pair{"bar", '|'}}) {
        const TextFile text{std::string{"7"} + letter + "5\n3" + letter + "6\n9" + letter + "8\n"};
        config::Config config;
        config.motion = described(text.path(), "2");
        config::apply_pair(config, "motion.separator", word, "test");
        EXPECT_NEAR(recorded::motion(config).increment_arcsec(0.0, 3.0), 19.0, 1e-12) << word;
    }
    const TextFile text{"0,5\n0,7\n"};
    config::Config config;
    config.motion = described(text.path());
    config::apply_pair(config, "motion.decimal", "comma", "test");
    EXPECT_NEAR(recorded::motion(config).increment_arcsec(0.0, 2.0), 1.2, 1e-12);
    config.motion.column = "2";
    config::apply_pair(config, "motion.separator", "comma", "test");
    config::apply_pair(config, "motion.decimal", "point", "test");
    EXPECT_NEAR(recorded::motion(config).increment_arcsec(0.0, 2.0), 12.0, 1e-12);
}

TEST(MotionFile, ARateIsDividedByTheRowsPerSecond) {
    const TextFile text{"50\n50\n"};
    config::Motion file = described(text.path());
    file.column_holds = config::ColumnHolds::rate;
    file.scale_arcsec = 2.0;
    file.rate_hz = 200.0;
    EXPECT_NEAR(motion_of_file(file).increment_arcsec(0.0, 0.01), 2.0 * 50.0 * 0.01, 1e-12);
}

TEST(MotionFile, AColumnOfTimesIsNoMotionUnlessItIsAskedFor) {
    const TextFile text{"t,w\n0.00,5.5\n0.01,6\n0.02,-7\n0.03,8\n"};
    config::Motion file = described(text.path());
    file.rate_hz = 100.0;
    expect_names(refusal(file), {"motion.column is not set", "column 1, 't'"});
    file.column = "w";
    EXPECT_NEAR(motion_of_file(file).increment_arcsec(0.0, 0.04), 12.5, 1e-12);
    file.rate_hz = 200.0;
    expect_names(refusal(file), {"motion.rate_hz = 200", "100 Hz"});
    file.time_column = "0";
    EXPECT_EQ(motion_of_file(file).duration_s(), 0.02);
}

TEST(MotionFile, TimesInAUnitThatNoNameSaysAreRefusedUnlessTheyAreSeconds) {
    const TextFile text{"t,w\n0,5.5\n10,6\n20,-7\n30,8\n"};
    config::Motion file = described(text.path(), "w");
    file.rate_hz = 100.0;
    expect_names(refusal(file), {"motion.rate_hz = 100", "read as milliseconds", "motion.time_column = 0"});
    file.time_column = "0";
    EXPECT_EQ(motion_of_file(file).duration_s(), 0.04);
}

TEST(MotionFile, RowsThatAreMissingByTheirTimesAreRefused) {
    std::string rows = "t w\n";
    for (int k = 0; k < 30; ++k)
        if (k != 12) rows += std::to_string(0.01 * k) + " " + std::to_string(k % 3) + ".5\n";
    const TextFile text{rows};
    config::Motion file = described(text.path(), "w");
    file.rate_hz = 100.0;
    expect_names(refusal(file), {"1 rows are missing", "after row 12"});
}

TEST(MotionFile, AMissingFileADirectoryAndAnEmptyFileAreNamed) {
    expect_names(refusal(described("/nowhere/at/all.txt")), {"/nowhere/at/all.txt"});
    expect_names(refusal(described(testing::TempDir())), {"it is a folder"});
    const TextFile text{"# only a comment\n\n"};
    expect_names(refusal(described(text.path())), {text.path(), "no rows"});
}

TEST(MotionFile, AShortRowIsNamedByItsLine) {
    const TextFile text{"# x y\n1 2\n3\n4 5\n"};
    expect_names(refusal(described(text.path(), "2")), {text.path(), ":3: 1 fields"});
}

TEST(MotionFile, WhatIsNotAFiniteNumberIsNamedByPlaceAndText) {
    for (const std::string bad : {"inf", "1e999", "1.5x", "abc", "--3", "+-3", "0x10"}) {
        const TextFile text{"1 1\n2 " + bad + "\n"};
        expect_names(refusal(described(text.path(), "2")), {":2, column 2", "'" + bad + "'", "finite number"});
    }
    const TextFile missing{"1,2.5\n2,\n3,nan\n"};
    expect_names(refusal(described(missing.path(), "2")), {"column 2", "nan in row 2", "finite number"});
}

// A real laser-gyro unit on the ground: what its three gyros see together is the rotation of the Earth.
TEST(MotionFile, ARealLogLoadsAndShowsTheEarth) {
    const std::filesystem::path path = std::filesystem::path{ZLG_SHARED_DIR} / "data" / "lasergyro.imu";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the recorded log " << path << " is not on this machine";
    double sum_sq = 0.0;
    for (int column = 1; column <= 3; ++column) {
        config::Motion file = described(path.string(), std::to_string(column));
        file.comment = "%";
        file.skip_lines = 3;
        file.scale_arcsec = 0.1;
        file.rate_hz = 100.0;
        const twin::Motion motion = motion_of_file(file);
        EXPECT_EQ(std::llround(motion.duration_s() * 100.0), 184718);
        const double rate = motion.increment_arcsec(0.0, motion.duration_s()) / motion.duration_s();
        sum_sq += rate * rate;
    }
    EXPECT_NEAR(std::sqrt(sum_sq), 14.86, 0.01);
}

}  // namespace zlg::recorded::motion_file_test
