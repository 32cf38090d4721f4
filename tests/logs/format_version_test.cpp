// Claims about the version that a log says: what a writer is given is what a reader finds, in both formats.

#include <zlg/logs/settings.hpp>

#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/raw_log.hpp>

#include "raw_rows.hpp"
#include "temporary_folder.hpp"

namespace zlg::logs::format_version_test {

using test::message_of;
using test::TemporaryFolder;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const Settings settings{{"gyro.tick_s", "0.005"}};

void write_raw(const std::string& path, const RawWriterOptions& options) {
    RawWriter log{path, settings, true, all_raw_columns, options};
    log.write({.half = 0, .counts = 150, .bias_sign = 1});
    log.close();
}

void write_angles(const std::string& path, const AngleWriterOptions& options) {
    AngleWriter log{path, 0.005, settings, true, options};
    log.write({.tick = 0});
    log.close();
}

class LoggedVersion : public testing::TestWithParam<const char*> {
protected:
    [[nodiscard]] std::string file(const std::string& stem) const { return folder_.file(stem + GetParam()); }
    const TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Formats, LoggedVersion, testing::Values(".csv", ".h5"),
                         [](const auto& format) { return std::string{format.param}.substr(1); });

TEST_P(LoggedVersion, is_the_present_one_where_nothing_else_is_asked) {
    write_raw(file("raw"), {});
    write_angles(file("angles"), {});
    EXPECT_EQ(RawReader{file("raw")}.header().format_version, 3);
    EXPECT_EQ(AngleReader{file("angles")}.header().format_version, 3);
}

TEST_P(LoggedVersion, is_the_one_that_the_writer_was_given_and_no_setting) {
    for (const FormatVersion version : {FormatVersion{1}, FormatVersion{2}, FormatVersion{3}, FormatVersion{}}) {
        write_raw(file("raw"), {.has_fingerprint = true, .format_version = version});
        write_angles(file("angles"), {.has_fingerprint = true, .format_version = version});
        const RawReader raw{file("raw")};
        const AngleReader angles{file("angles")};
        EXPECT_EQ(raw.header().format_version, version);
        EXPECT_EQ(angles.header().format_version, version);
        EXPECT_EQ(raw.header().settings, settings);
        for (const auto& [key, value] : angles.header().settings) EXPECT_NE(key, "format_version");
    }
}

TEST_P(LoggedVersion, that_there_is_not_is_not_written) {
    for (const int wrong : {0, 4}) {
        const std::string says = "format_version is " + std::to_string(wrong) + "; allowed is 1 to 3";
        test::expect_contains(message_of<FormatError>([&] { write_raw(file("raw"), {.format_version = wrong}); }),
                              says);
        test::expect_contains(message_of<FormatError>([&] { write_angles(file("angles"), {.format_version = wrong}); }),
                              says);
    }
}

TEST(LoggedVersionCsv, is_refused_where_it_is_no_version_or_two) {
    const TemporaryFolder folder;
    const auto complaint = [&folder](const std::string& lines) {
        const std::string path =
            folder.write("raw.csv", lines + "half,bias_sign,mode,counts,loop_closed\n0,1,1,5,1\n1,-1,1,-5,1\n");
        return message_of<FormatError>([&] { RawReader{path}; });
    };
    test::expect_contains(complaint("# format_version = 4\n"), "format_version is 4; allowed is 1 to 3");
    test::expect_contains(complaint("# format_version = two\n"), "format_version is 'two'; allowed is a number");
    test::expect_contains(complaint("# format_version = 1\n# format_version = 2\n"), "stands twice, as 1 and as 2");
}

TEST(FormatVersion, of_a_number_is_1_to_3) {
    for (const int known : {1, 2, 3}) EXPECT_EQ(checked_format_version(known, "log"), known);
    for (const double wrong : {0.0, 1.5, 4.0, -1.0, nan})
        test::expect_contains(message_of<FormatError>([&] { (void)checked_format_version(wrong, "log"); }),
                              "log: format_version");
}

}  // namespace zlg::logs::format_version_test
