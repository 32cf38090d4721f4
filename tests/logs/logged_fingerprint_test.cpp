// Claims about the fingerprint of a run in a raw log and in an angle log, CSV and HDF5.

#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/raw_log.hpp>

#include "hdf5_file.hpp"
#include "raw_rows.hpp"
#include "temporary_folder.hpp"

namespace zlg::logs::logged_fingerprint_test {

using test::message_of;
using test::TemporaryFolder;

const std::string digits = "0123456789abcdef";
const Settings settings{{"gyro.tick_s", "0.005"}, {"laboratory", "12"}};

core::HalfRecord half_of(std::int64_t half) {
    return {.half = half,
            .counts = half % 2 == 0 ? 150 : -150,
            .bias_sign = static_cast<std::int8_t>(half % 2 == 0 ? 1 : -1)};
}

// A log of either kind, with room for a fingerprint.
RawWriter raw_writer(const std::string& path, bool has_fingerprint = true) {
    return {path, settings, true, all_raw_columns, {.keep_part = true, .has_fingerprint = has_fingerprint}};
}
AngleWriter angle_writer(const std::string& path, bool has_fingerprint = true) {
    return {path, 0.005, settings, true, {.keep_part = true, .has_fingerprint = has_fingerprint}};
}

void write_rows(RawWriter& log, std::int64_t n) {
    for (std::int64_t half = 0; half < n; ++half) log.write(half_of(half));
}
void write_rows(AngleWriter& log, std::int64_t n) {
    for (std::int64_t tick = 0; tick < n; ++tick) log.write({.tick = tick});
}

bool has_setting(const Settings& all, const std::string& key) {
    return std::ranges::any_of(all, [&](const auto& setting) { return setting.first == key; });
}

class LoggedFingerprint : public testing::TestWithParam<const char*> {
protected:
    [[nodiscard]] std::string file(const std::string& stem) const { return folder_.file(stem + GetParam()); }
    const TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Formats, LoggedFingerprint, testing::Values(".csv", ".h5"),
                         [](const auto& format) { return std::string{format.param}.substr(1); });

template <class Reader, class Writer> void expect_read_back(Writer log, const std::string& path) {
    constexpr std::int64_t n_rows = 50'000;  // several blocks of HDF5, more than a buffer of CSV
    write_rows(log, n_rows);
    log.set_fingerprint(digits);
    log.close();
    Reader reader{path};
    EXPECT_EQ(reader.header().fingerprint, digits);
    EXPECT_FALSE(has_setting(reader.header().settings, "fingerprint"));
    EXPECT_TRUE(has_setting(reader.header().settings, "laboratory"));
    std::int64_t n = 0;
    for (std::conditional_t<std::is_same_v<Reader, RawReader>, core::HalfRecord, TimedAngle> row; reader.next(row);)
        ++n;
    EXPECT_EQ(n, n_rows);
}

TEST_P(LoggedFingerprint, reads_back_and_is_no_setting) {
    expect_read_back<RawReader>(raw_writer(file("raw")), file("raw"));
    expect_read_back<AngleReader>(angle_writer(file("angles")), file("angles"));
}

TEST_P(LoggedFingerprint, may_be_set_before_the_rows_and_again) {
    RawWriter log = raw_writer(file("raw"));
    log.set_fingerprint("ffffffffffffffff");
    write_rows(log, 4);
    log.set_fingerprint(digits);
    write_rows(log, 0);
    log.close();
    EXPECT_EQ(RawReader{file("raw")}.header().fingerprint, digits);
    EXPECT_EQ(test::rows_of(file("raw")).size(), 4u);
}

TEST_P(LoggedFingerprint, changes_nothing_else_in_the_log) {
    for (const bool has_fingerprint : {false, true}) {
        RawWriter log = raw_writer(file(has_fingerprint ? "with" : "without"), has_fingerprint);
        write_rows(log, 100);
        if (has_fingerprint) log.set_fingerprint(digits);
        log.close();
    }
    EXPECT_EQ(test::rows_of(file("with")), test::rows_of(file("without")));
    EXPECT_EQ(RawReader{file("with")}.header().settings, RawReader{file("without")}.header().settings);
    EXPECT_EQ(RawReader{file("without")}.header().fingerprint, "");
    if (file("").ends_with("csv"))
        EXPECT_EQ(test::content_of(file("with")),
                  "# fingerprint = " + digits + "\n" + test::content_of(file("without")));
}

TEST_P(LoggedFingerprint, that_was_not_set_is_none) {
    RawWriter raw = raw_writer(file("raw"));
    write_rows(raw, 2);
    raw.close();
    EXPECT_EQ(RawReader{file("raw")}.header().fingerprint, "");
    EXPECT_EQ(RawReader{file("raw")}.header().settings, settings);
    AngleWriter angles = angle_writer(file("angles"));
    write_rows(angles, 2);
    angles.close();
    EXPECT_EQ(AngleReader{file("angles")}.header().fingerprint, "");
    EXPECT_FALSE(has_setting(AngleReader{file("angles")}.header().settings, "fingerprint"));
}

TEST_P(LoggedFingerprint, is_refused_if_it_is_none_or_has_no_room) {
    RawWriter raw = raw_writer(file("raw"));
    for (const char* wrong : {"", "0123456789abcde", "0123456789abcdef0", "0123456789ABCDEF", "0123456789abcde\n"}) {
        const std::string message = message_of<FormatError>([&] { raw.set_fingerprint(wrong); });
        test::expect_contains(message, "allowed are 16 hexadecimal digits");
    }
    AngleWriter angles = angle_writer(file("angles"), false);
    test::expect_contains(message_of<FormatError>([&] { angles.set_fingerprint(digits); }), "no room");
}

TEST(LoggedFingerprintCsv, of_another_form_is_a_note_of_the_laboratory) {
    const TemporaryFolder folder;
    const std::string rows = "half,bias_sign,mode,counts,loop_closed\n0,1,1,5,1\n1,-1,1,-5,1\n";
    for (const char* note : {"left thumb", "0123456789ABCDEF", "0123", ""}) {
        const RawReader reader{folder.write("raw.csv", std::string{"# fingerprint = "} + note + "\n" + rows)};
        EXPECT_EQ(reader.header().fingerprint, "");
        EXPECT_EQ(reader.header().settings, (Settings{{"fingerprint", note}}));
    }
}

TEST(LoggedFingerprintCsv, that_stands_twice_is_refused_where_both_differ) {
    const TemporaryFolder folder;
    const auto log_of = [&folder](const std::string& second) {
        return folder.write("raw.csv", "# fingerprint = " + digits + "\n# fingerprint = " + second +
                                           "\nhalf,bias_sign,mode,counts,loop_closed\n0,1,1,5,1\n1,-1,1,-5,1\n");
    };
    const std::string other = "0123456789abcdee";
    const std::string path = log_of(other);
    EXPECT_EQ(message_of<FormatError>([&] { RawReader{path}; }),
              path + ": fingerprint stands twice, as " + digits + " and as " + other + "; allowed is one value");
    for (const std::string& second : {digits, std::string{"left thumb"}})
        EXPECT_EQ(RawReader{log_of(second)}.header().fingerprint, digits) << second;
}

TEST(LoggedFingerprintHdf5, can_be_written_anew_by_another_program) {
    const TemporaryFolder folder;
    const std::string path = folder.file("raw.h5");
    RawWriter log = raw_writer(path);
    write_rows(log, 2);
    log.set_fingerprint(digits);
    log.close();
    const std::string anew = "fedcba9876543210";
    test::Hdf5File{path, true}.overwrite_text("/fingerprint", anew);
    EXPECT_EQ(RawReader{path}.header().fingerprint, anew);
}

TEST(LoggedFingerprintHdf5, of_a_log_that_is_not_complete_is_none) {
    const TemporaryFolder folder;
    const std::string path = folder.file("raw.h5");
    std::optional<RawWriter> log{raw_writer(path)};
    write_rows(*log, 100);
    log->flush();
    RawReader growing{path + ".part"};
    EXPECT_EQ(growing.header().fingerprint, "");
    log->set_fingerprint(digits);
    growing.refresh();
    EXPECT_FALSE(growing.header().complete);
    EXPECT_EQ(growing.header().fingerprint, "");
    EXPECT_EQ(RawReader{path + ".part"}.header().fingerprint, "");
    log->close();
    growing.refresh();
    EXPECT_TRUE(growing.header().complete);
    EXPECT_EQ(growing.header().fingerprint, digits);
}

TEST(LoggedFingerprintHdf5, of_another_form_is_refused) {
    const TemporaryFolder folder;
    for (const char* wrong : {"left thumb", "0123456789ABCDEF", "0123456789abcdef0"}) {
        const std::string path = folder.file("raw.h5");
        RawWriter log = raw_writer(path, false);
        write_rows(log, 2);
        log.close();
        test::Hdf5File{path, true}.text("/fingerprint", wrong);
        const std::string message = message_of<FormatError>([&] { RawReader{path}; });
        test::expect_contains(message, "/fingerprint: the fingerprint is '");
    }
}

}  // namespace zlg::logs::logged_fingerprint_test
