#include <rapidcheck/gtest.h>

#include <zlg/logs/error.hpp>
#include <zlg/logs/raw_log.hpp>

#include "any_rows.hpp"
#include "hdf5_file.hpp"
#include "raw_rows.hpp"
#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;
using zlg::core::HalfRecord;
using Settings = std::vector<std::pair<std::string, std::string>>;

namespace {

void copy(const std::string& from, const std::string& to) {
    RawReader reader{from};
    RawWriter writer{to, reader.header().settings, false, reader.header()};
    for (HalfRecord row; reader.next(row);) writer.write(row);
    writer.close();
}

// Lines as they stand in CSV logs: words, numbers, strings, lists, nonsense.
Settings any_settings() {
    const std::string letters = "ab1.-_+eE'\"[]{}=#, \\\tz";
    Settings settings(*rc::gen::inRange<std::size_t>(0, 8));
    for (auto& [key, value] : settings) {
        key = *rc::gen::element<std::string>("gyro.bias_hz", "gyro.bias_chi", "gyro.bias_hz.x", "motion.path", "note",
                                             "a.b", "a..b", "a.b'c", "drift.magnetic_arcsec_s");
        value = *rc::gen::oneOf(
            rc::gen::element<std::string>("60e3", "6_0.0", "-0.0", "\"a # b\"", "'literal'", "'bare word'", "quadratic",
                                          "[1, 2.50]", "[1, # 2", "{x = 1}", "inf", "nan", "2026-01-01", "0x1F", "",
                                          "\"µ°\"", "10 µm", "true", "1 # one"),
            rc::gen::container<std::string>(rc::gen::elementOf(letters)));
        const auto first = value.find_first_not_of(" \t");
        value = first == std::string::npos ? "" : value.substr(first, value.find_last_not_of(" \t") - first + 1);
    }
    return settings;
}

}  // namespace

RC_GTEST_PROP(RawLogHdf5, csv_to_hdf5_to_csv_is_the_same_file, ()) {
    const TemporaryFolder folder;
    const std::string first = folder.file("first.csv");
    RawColumns columns{*rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>(),
                       *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>()};
    columns.timer_hz = *rc::gen::element(1e7, 12345.678, 1.0, 1e15);
    RawWriter writer{first, any_settings(), false, columns};
    for (const HalfRecord& row : any_records(columns.has_edge_offset)) writer.write(row);
    writer.close();
    copy(first, folder.file("second.h5"));
    copy(folder.file("second.h5"), folder.file("third.csv"));
    RC_ASSERT(content_of(folder.file("third.csv")) == content_of(first));
}

RC_GTEST_PROP(RawLogHdf5, hdf5_reads_back_the_same_bits, ()) {
    const TemporaryFolder folder;
    const std::vector<HalfRecord> rows = any_records();
    RawWriter writer{folder.file("raw.h5"), {}, false};
    for (const HalfRecord& row : rows) writer.write(row);
    writer.close();
    RC_ASSERT(rows_of(folder.file("raw.h5")) == rows);
}

RC_GTEST_PROP(RawLogHdf5, shifts_of_edges_read_back_the_same_in_both_formats, ()) {
    const TemporaryFolder folder;
    const std::vector<HalfRecord> rows = any_records(true);
    RawColumns columns = all_raw_columns;
    columns.has_edge_offset = true;
    columns.timer_hz = 1e7 / 3.0;
    for (const char* name : {"raw.h5", "raw.csv"}) {
        RawWriter writer{folder.file(name), {{"gyro.tick_s", "0.005"}}, false, columns};
        for (const HalfRecord& row : rows) writer.write(row);
        writer.close();
        RawReader reader{folder.file(name)};
        RC_ASSERT(reader.header().has_edge_offset);
        RC_ASSERT(reader.header().timer_hz == 1e7 / 3.0);
        RC_ASSERT(reader.header().settings.size() == 1u);
        RC_ASSERT(rows_of(reader) == rows);
    }
}

// A damaged file is refused with an error of ours, or it is still a log: never anything else.
RC_GTEST_PROP(RawLogHdf5, a_cut_file_is_an_error, ()) {
    const TemporaryFolder folder;
    const std::string path = folder.file("raw.h5");
    RawWriter writer{path, {{"gyro.tick_s", "0.005"}}, false};
    for (int half = 0; half < 3; ++half) writer.write(row_of(half));
    writer.close();
    std::filesystem::resize_file(path, *rc::gen::inRange<std::uintmax_t>(0, std::filesystem::file_size(path)));
    try {
        static_cast<void>(rows_of(path));
        RC_FAIL("a cut file was read");
    } catch (const FormatError& error) {
        RC_ASSERT(std::string{error.what()}.find('\n') == std::string::npos);
    }
}

TEST(RawLogHdf5, of_many_blocks_is_read_whole) {
    const TemporaryFolder folder;
    constexpr int n = 50'000;
    RawWriter writer{folder.file("raw.h5"), {}, false};
    for (int half = 0; half < n; ++half) {
        writer.write(row_of(half));
        if (half % 4999 == 0 || half == 16'383) writer.flush();  // which changes no bit
    }
    writer.close();
    RawReader reader{folder.file("raw.h5")};
    HalfRecord row;
    for (int half = 0; half < n; ++half) {
        ASSERT_TRUE(reader.next(row));
        ASSERT_EQ(row, row_of(half));
        if (half == 0) EXPECT_LT(reader.fraction_read(), 0.5);
    }
    EXPECT_FALSE(reader.next(row));
    EXPECT_EQ(reader.fraction_read(), 1.0);
    EXPECT_TRUE(reader.line_is_ended());
    EXPECT_TRUE(reader.header().complete);
    EXPECT_FALSE(reader.refresh());
    EXPECT_FALSE(std::filesystem::exists(writer.part_path()));
}

TEST(RawLogHdf5, the_same_rows_make_the_same_file) {
    const TemporaryFolder folder;
    for (const char* name : {"a.h5", "b.hdf5"}) {
        RawWriter writer{folder.file(name), {{"run.seed", "1"}}, false, all_raw_columns, {.light_samples = 2}};
        const std::array<float, 2> light{0.25f, 0.75f};
        for (int half = 0; half < 20'000; ++half) writer.write(row_of(half), {light});
        writer.close();
    }
    EXPECT_TRUE(content_of(folder.file("a.h5")) == content_of(folder.file("b.hdf5")));
}

TEST(RawLogHdf5, light_samples_come_back_with_their_row) {
    const TemporaryFolder folder;
    RawWriter writer{folder.file("raw.h5"), {}, false, all_raw_columns, {.light_samples = 16, .light_b = true}};
    std::array<float, 16> light{};
    std::array<float, 16> other{};
    const auto fill = [&](int half) {
        for (std::size_t k = 0; k < 16; ++k) {
            light[k] = 0.001f * static_cast<float>(16 * half + static_cast<int>(k));
            other[k] = 1.0f - light[k];
        }
    };
    for (int half = 0; half < 20'000; ++half) {
        fill(half);
        writer.write(row_of(half), {light, other});
    }
    writer.close();
    RawReader reader{folder.file("raw.h5")};
    EXPECT_EQ(reader.header().light_samples, 16);
    EXPECT_TRUE(reader.header().has_light_b);
    EXPECT_TRUE(reader.light().a.empty());
    EXPECT_TRUE(reader.light().b.empty());
    HalfRecord row;
    for (int half = 0; reader.next(row); ++half) {
        fill(half);
        ASSERT_TRUE(std::ranges::equal(reader.light().a, light)) << half;
        ASSERT_TRUE(std::ranges::equal(reader.light().b, other)) << half;
    }
    EXPECT_EQ(row.half, 19'999);
    EXPECT_TRUE(std::ranges::equal(reader.light().a, light)) << "of the row that was read last, also at the end";
}

TEST(RawLogHdf5, a_log_of_one_beam_has_no_other) {
    const TemporaryFolder folder;
    RawWriter writer{folder.file("raw.h5"), {}, false, all_raw_columns, {.light_samples = 2}};
    const std::array<float, 2> light{0.25f, 0.75f};
    writer.write(row_of(0), {light, light});
    writer.close();
    RawReader reader{folder.file("raw.h5")};
    EXPECT_FALSE(reader.header().has_light_b);
    HalfRecord row;
    ASSERT_TRUE(reader.next(row));
    EXPECT_TRUE(std::ranges::equal(reader.light().a, light));
    EXPECT_TRUE(reader.light().b.empty());
}

TEST(RawLogHdf5, light_samples_are_as_many_as_announced_and_not_infinite) {
    const TemporaryFolder folder;
    RawWriter writer{folder.file("raw.h5"), {}, false, all_raw_columns, {.light_samples = 2, .light_b = true}};
    const std::array<float, 2> good{};
    const std::array<float, 3> three{};
    const std::array<float, 2> not_finite{0.0f, std::numeric_limits<float>::infinity()};
    expect_contains(message_of<FormatError>([&] { writer.write(row_of(0), {three}); }),
                    "3 samples of light; allowed are 2");
    expect_contains(message_of<FormatError>([&] { writer.write(row_of(0)); }), "0 samples of light");
    expect_contains(message_of<FormatError>([&] { writer.write(row_of(0), {not_finite}); }), "light is inf");
    expect_contains(message_of<FormatError>([&] { writer.write(row_of(0), {good}); }), "0 samples of light_b");
    expect_contains(message_of<FormatError>([&] { writer.write(row_of(0), {good, not_finite}); }), "light_b is inf");
    const auto make = [&](const char* name, int n) {
        return message_of<FormatError>(
            [&] { RawWriter(folder.file(name), {}, false, all_raw_columns, {.light_samples = n}); });
    };
    expect_contains(make("b.csv", 1), "a CSV log holds no light samples");
    expect_contains(make("b.h5", 65), "65 light samples in a half; allowed is 0..64");
    expect_contains(
        message_of<FormatError>([&] { RawWriter(folder.file("b.h5"), {}, false, all_raw_columns, {.light_b = true}); }),
        "allowed is with those of beam A");
    EXPECT_FALSE(std::filesystem::exists(folder.file("b.h5.part")));
}

TEST(RawLogHdf5, is_left_as_it_is_by_its_readers) {
    const TemporaryFolder folder;
    RawWriter writer{folder.file("raw.h5"), {}, false};
    for (int half = 0; half < 100; ++half) writer.write(row_of(half));
    writer.flush();
    const std::string before = content_of(writer.part_path());
    EXPECT_EQ(rows_of(writer.part_path()).size(), 100u);
    EXPECT_TRUE(content_of(writer.part_path()) == before);
}
