#include <rapidcheck/gtest.h>

#include <zlg/logs/error.hpp>
#include <zlg/logs/raw_log.hpp>

#include "any_rows.hpp"
#include "raw_rows.hpp"
#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;
using zlg::core::HalfRecord;

namespace {

const std::string names = "half,bias_sign,mode,counts,loop_closed\n";

std::vector<HalfRecord> read_text(const std::string& text) {
    const TemporaryFolder folder;
    RawReader reader{folder.write("raw.csv", text)};
    return rows_of(reader);
}

RawHeader header_of(const std::string& text) {
    const TemporaryFolder folder;
    return RawReader{folder.write("raw.csv", text)}.header();
}

// What the reader says of a text, without the folder that precedes the file's name.
std::string complaint(const std::string& text) {
    const std::string message = message_of<FormatError>([&] { static_cast<void>(read_text(text)); });
    expect_contains(message, "raw.csv");
    return message.substr(std::min(message.find("raw.csv"), message.size()));
}

}  // namespace

RC_GTEST_PROP(RawLog, what_is_written_reads_back_the_same, ()) {
    const TemporaryFolder folder;
    const std::vector<HalfRecord> rows = any_records();
    RawWriter writer{folder.file("raw.csv"), {{"gyro.tick_s", "0.005"}, {"motion.comment", "\"#\""}}, false};
    for (const HalfRecord& row : rows) writer.write(row);
    writer.close();
    RawReader reader{folder.file("raw.csv")};
    RC_ASSERT(reader.header().settings.size() == 2u);
    RC_ASSERT(reader.header().settings[1].second == "\"#\"");
    RC_ASSERT(rows_of(reader) == rows);
}

// A damaged log is refused with the reader's own error, or it is still a log: never anything else.
RC_GTEST_PROP(RawReader, any_damage_is_a_format_error_or_harmless, ()) {
    std::string text = "# gyro.tick_s = 0.005\n" + names + "0,1,1,150,1\n1,-1,1,-148,1\n2,1,1,151,1\n";
    const auto n_changes = *rc::gen::inRange(1, 5);
    for (int i = 0; i < n_changes; ++i) {
        text[*rc::gen::inRange<std::size_t>(0, text.size())] =
            *rc::gen::oneOf(rc::gen::arbitrary<char>(), rc::gen::elementOf(std::string{",\n\r-+.#=0123456789eE \t"}));
    }
    try {
        std::int64_t expected = 0;
        for (const HalfRecord& row : read_text(text)) RC_ASSERT(row.half == expected++);
    } catch (const FormatError& error) {
        RC_ASSERT(std::string{error.what()}.find('\n') == std::string::npos);
    }
}

TEST(RawReader, reads_columns_in_any_order_and_of_any_line_end) {
    const auto rows = read_text(
        "# instrument = 7\r\n counts ,loop_closed,half, bias_sign,mode,temperature_c\r\n"
        "-12,1,0,-1,1,20.5\r\n13,0, 1 ,+1,-1,+2e1\r\n");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].counts, -12);
    EXPECT_EQ(rows[0].bias_sign, -1);
    EXPECT_EQ(rows[0].mode, 1);
    EXPECT_TRUE(rows[0].loop_closed);
    EXPECT_EQ(rows[0].temperature_c, 20.5);
    EXPECT_EQ(rows[1].half, 1);
    EXPECT_EQ(rows[1].bias_sign, 1);
    EXPECT_EQ(rows[1].mode, -1);
    EXPECT_FALSE(rows[1].loop_closed);
    EXPECT_EQ(rows[1].temperature_c, 20.0);
}

TEST(RawReader, an_absent_column_is_valid_or_nan) {
    const auto rows = read_text(names + "0,1,1,5,1\n");
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_TRUE(rows[0].valid);
    EXPECT_TRUE(std::isnan(rows[0].detuning_lambda));
    EXPECT_TRUE(std::isnan(rows[0].detuning_sq_lambda2));
    EXPECT_TRUE(std::isnan(rows[0].piezo_v));
    EXPECT_TRUE(std::isnan(rows[0].temperature_c));
}

TEST(RawReader, the_header_says_which_optional_columns_there_are) {
    const RawHeader none = header_of(names + "0,1,1,5,1\n");
    EXPECT_FALSE(none.has_valid || none.has_detuning || none.has_detuning_sq || none.has_piezo || none.has_temperature);
    const RawHeader one = header_of("half,bias_sign,mode,counts,loop_closed,detuning_sq_lambda2\n0,1,1,5,1,0\n");
    EXPECT_TRUE(one.has_detuning_sq);
    EXPECT_FALSE(one.has_detuning || one.has_valid || one.has_piezo || one.has_temperature);
    const RawHeader others = header_of(
        "half,bias_sign,mode,counts,loop_closed,valid,detuning_lambda,piezo_v,temperature_c\n0,1,1,5,1,1,0,0,0\n");
    EXPECT_TRUE(others.has_valid && others.has_detuning && others.has_piezo && others.has_temperature);
    EXPECT_FALSE(others.has_detuning_sq);
}

TEST(RawReader, collects_settings_and_ignores_remarks) {
    const auto settings =
        header_of("# gyro.tick_s = 0.005\n#motion.comment=\"a = b\"\n# a remark\n# measured with a = 3\n\n" + names +
                  "0,1,1,5,1\n")
            .settings;
    ASSERT_EQ(settings.size(), 2u);
    EXPECT_EQ(settings[0], (std::pair<std::string, std::string>{"gyro.tick_s", "0.005"}));
    EXPECT_EQ(settings[1], (std::pair<std::string, std::string>{"motion.comment", "\"a = b\""}));
}

TEST(RawReader, ignores_an_unknown_column_with_a_warning) {
    const auto warnings = header_of("half,bias_sign,mode,counts,loop_closed,operator\n0,1,1,5,1,Ann\n").warnings;
    ASSERT_EQ(warnings.size(), 1u);
    expect_contains(warnings[0], "raw.csv:1: the unknown column 'operator' is ignored");
}

TEST(RawReader, refuses_a_column_within_two_letters_of_a_known_one) {
    expect_contains(complaint("half,bias_sign,mode,counts,loop_closed,valld\n0,1,1,5,1,1\n"),
                    "raw.csv:1: unknown column 'valld'; did you mean 'valid'?");
    expect_contains(complaint("half,bias_sign,mode,counts,loop_closed,piezo\n0,1,1,5,1,1\n"),
                    "did you mean 'piezo_v'?");
    EXPECT_EQ(header_of("half,bias_sign,mode,counts,loop_closed,piez\n0,1,1,5,1,1\n").warnings.size(), 1u);
}

TEST(RawReader, refuses_a_doubled_missing_or_nameless_column) {
    expect_contains(complaint("half,bias_sign,mode,counts,loop_closed,half\n0,1,1,5,1,0\n"),
                    "'half' stands there twice");
    expect_contains(complaint("half,bias_sign,mode,counts,loop_closed,\n0,1,1,5,1,\n"), "column 6 of 6 has no name");
    for (const std::string absent : {"half,", "bias_sign,", "mode,", "counts,"}) {
        std::string rest = names;
        rest.erase(rest.find(absent), absent.size());
        expect_contains(complaint(rest + "0,0,0,0\n"), "'" + absent.substr(0, absent.size() - 1) + "' is missing");
    }
    expect_contains(complaint("half,bias_sign,mode,counts\n0,1,1,5\n"), "'loop_closed' is missing");
    expect_contains(complaint("0,1,1,5,1\n1,-1,1,5,1\n"), "raw.csv:1: a row of numbers");
}

TEST(RawReader, refuses_a_file_without_rows) {
    for (const std::string& text :
         {std::string{}, std::string{"\n"}, std::string{"# a = b\n"}, names, names + "\n\n"}) {
        expect_contains(complaint(text), "raw.csv is empty");
    }
}

TEST(RawReader, names_line_row_column_value_and_what_is_allowed) {
    EXPECT_EQ(complaint("# a = b\n" + names + "0,1,1,5,1\n1,-1,1,12.5,1\n"),
              "raw.csv:4, row 2, column 'counts': '12.5' is not an integer; allowed is "
              "-4503599627370496..4503599627370496");
}

TEST(RawReader, refuses_values_that_no_gyro_can_have_recorded) {
    const auto row = [](const std::string& text) { return complaint(names + text + "\n"); };
    expect_contains(row("0,2,1,5,1"), "column 'bias_sign': '2' is out of range; allowed is +1 or -1");
    expect_contains(row("0,1,0,5,1"), "column 'mode': '0' is out of range; allowed is +1 or -1");
    expect_contains(row("0,1,1,5,2"), "column 'loop_closed': '2' is out of range; allowed is 0 or 1");
    expect_contains(row("0,1.0,1,5,1"), "'1.0' is not an integer");
    expect_contains(row("0,1,1,,1"), "'' is not an integer");
    expect_contains(row("0,1,1,+-5,1"), "'+-5' is not an integer");
    expect_contains(row("0,1,1,4503599627370497,1"), "out of range");
    expect_contains(row("0,1,1,99999999999999999999,1"), "out of range");
    EXPECT_EQ(read_text(names + "0,1,1,-4503599627370496,1\n")[0].counts, -(std::int64_t{1} << 52));
}

TEST(RawReader, refuses_detunings_that_no_perimeter_can_have) {
    const std::string head = "half,bias_sign,mode,counts,loop_closed,detuning_lambda,detuning_sq_lambda2\n0,1,1,5,1,";
    const auto row = [&](const std::string& text) { return complaint(head + text + "\n"); };
    expect_contains(row("30.1,910"),
                    "column 'detuning_lambda': '30.1' is out of range; allowed is -30..30 wavelengths");
    expect_contains(row("0.01,-1e-9"),
                    "raw.csv:2, row 1, column 'detuning_sq_lambda2': '-1e-9' is out of range; allowed is 0..900");
    expect_contains(row("0.01,5000"), "'5000' is out of range; allowed is 0..900 wavelengths^2");
    for (const std::string good : {"-0.2,0.04", "-0.2,0.01", "0.2,0.039", "0.2,0", "-30,900", "0.01,0", "0,0.3"})
        EXPECT_EQ(read_text(head + good + "\n").size(), 1u) << good;
    EXPECT_EQ(read_text("half,bias_sign,mode,counts,loop_closed,detuning_sq_lambda2\n0,1,1,5,1,0.01\n").size(), 1u);
}

TEST(RawReader, tells_a_truncated_log_from_one_without_a_last_line_end) {
    EXPECT_EQ(read_text(names + "0,1,1,5,1\n1,-1,1,7,0").size(), 2u);
    expect_contains(complaint(names + "0,1,1,5,1\n1,-1,1"), "raw.csv:3, row 2: truncated");
    expect_contains(complaint(names + "0,1,1,5,1\n1,-1,1,7,"), "may be truncated");
    const std::string in_the_middle = complaint(names + "0,1,1\n1,-1,1,7,1\n");
    expect_contains(in_the_middle, "raw.csv:2, row 1: 3 fields, where the column names are 5");
}

TEST(RawReader, refuses_rows_of_another_width_and_lines_that_are_no_rows) {
    expect_contains(complaint(names + "0,1,1,5,1,9\n"), "6 fields, where the column names are 5");
    expect_contains(complaint(names + "0,1,1,5,1\n# remark\n"), "must stand above the column names");
    expect_contains(complaint(names + "0,1,1,5,1\n\n1,-1,1,5,1\n"), "an empty line between rows");
    EXPECT_EQ(read_text(names + "0,1,1,5,1\n\n\r\n").size(), 1u);
}

TEST(RawReader, refuses_what_is_no_text) {
    std::string text = names + "0,1,1,5,1\n";
    text[text.size() - 4] = '\0';
    expect_contains(complaint(text), "raw.csv:2: a NUL byte");
    expect_contains(complaint(std::string(3u << 20, 'a')), "a line of more than 1048576 bytes");
}

TEST(RawReader, a_file_that_cannot_be_read_is_an_io_error) {
    const TemporaryFolder folder;
    expect_contains(message_of<IoError>([&] { RawReader{folder.file("none.csv")}; }), "none.csv: No such file");
    expect_contains(message_of<IoError>([&] { RawReader{folder.file("")}; }), "Is a directory");
}

TEST(RawWriter, writes_settings_names_and_shortest_numbers) {
    const TemporaryFolder folder;
    RawWriter writer{folder.file("raw.csv"), {{"gyro.scale_arcsec", "3.263"}}, false};
    writer.write({.half = 0,
                  .counts = -150,
                  .detuning_lambda = 0.1,
                  .detuning_sq_lambda2 = 0.01,
                  .piezo_v = 150.0,
                  .temperature_c = 20.25,
                  .bias_sign = -1,
                  .mode = 1,
                  .loop_closed = true,
                  .valid = false});
    writer.close();
    EXPECT_EQ(content_of(folder.file("raw.csv")),
              "# format_version = 3\n# gyro.scale_arcsec = 3.263\n"
              "half,bias_sign,mode,counts,loop_closed,valid,detuning_lambda,detuning_sq_lambda2,piezo_v,temperature_c,"
              "span,lit\n"
              "0,-1,1,-150,1,0,0.1,0.01,150,20.25,1,0\n");
}

TEST(RawWriter, refuses_what_no_reader_accepts) {
    const TemporaryFolder folder;
    RawWriter writer{folder.file("raw.csv"), {}, false};
    HalfRecord record;
    record.piezo_v = std::numeric_limits<double>::quiet_NaN();
    expect_contains(message_of<FormatError>([&] { writer.write(record); }), "half 0");
    expect_contains(message_of<FormatError>([&] {
                        RawWriter(folder.file("b.csv"), {{"a", "1\n2"}}, false);
                    }),
                    "line break");
}

TEST(RawWriter, refuses_detunings_that_no_reader_accepts) {
    const TemporaryFolder folder;
    for (const std::string name : {"raw.csv", "raw.h5"}) {
        RawWriter writer{folder.file(name), {}, false};
        EXPECT_EQ(message_of<FormatError>([&] { writer.write({.detuning_sq_lambda2 = -1.0}); }),
                  "half 0 cannot be logged: detuning_sq_lambda2 = -1 is out of range; allowed is 0..900 wavelengths^2");
        expect_contains(message_of<FormatError>([&] { writer.write({.detuning_lambda = 1e3}); }), "-30..30");
        writer.write({.detuning_lambda = 0.2});
    }
}

TEST(RawWriter, has_room_for_the_longest_row) {
    const TemporaryFolder folder;
    RawWriter writer{folder.file("raw.csv"), {}, false};
    const double longest = -2.2250738585072014e-308;
    const HalfRecord row{.half = std::numeric_limits<std::int64_t>::min(),
                         .counts = std::numeric_limits<std::int64_t>::min(),
                         .detuning_lambda = longest,
                         .detuning_sq_lambda2 = -longest,
                         .piezo_v = longest,
                         .temperature_c = longest,
                         .bias_sign = -1,
                         .mode = -1,
                         .span = std::numeric_limits<std::int32_t>::min()};
    writer.write(row);
    writer.close();
    const std::string text = content_of(folder.file("raw.csv"));
    EXPECT_EQ(text.substr(text.find("lit\n") + 4),
              "-9223372036854775808,-1,-1,-9223372036854775808,1,1,-2.2250738585072014e-308,2.2250738585072014e-308,"
              "-2.2250738585072014e-308,-2.2250738585072014e-308,-2147483648,0\n");
}

TEST(RawReader, knows_how_much_of_the_file_it_has_read) {
    const TemporaryFolder folder;
    std::string text = names;
    for (int half = 0; half < 200'000; ++half)
        text += std::to_string(half) + (half % 2 == 0 ? ",1,1,151,1\n" : ",-1,1,-149,1\n");
    RawReader reader{folder.write("raw.csv", text)};
    const double before = reader.fraction_read();
    EXPECT_GT(before, 0.0);
    EXPECT_LT(before, 0.5) << "3 MB are read in pieces of 1 MiB";
    const auto rows = rows_of(reader);
    EXPECT_EQ(reader.fraction_read(), 1.0);
    ASSERT_EQ(rows.size(), 200'000u);
    for (const HalfRecord& row : rows) ASSERT_EQ(row.counts, row.bias_sign > 0 ? 151 : -149);
}

TEST(RawReader, tells_a_last_line_that_may_have_been_cut_off) {
    const TemporaryFolder folder;
    const std::string rows = names + "0,1,1,151,1\n1,-1,1,-149,1";
    RawReader whole{folder.write("whole.csv", rows + "\n")};
    RawReader cut{folder.write("cut.csv", rows)};
    (void)rows_of(whole);
    (void)rows_of(cut);
    EXPECT_TRUE(whole.line_is_ended());
    EXPECT_FALSE(cut.line_is_ended());
}

TEST(RawLog, without_shifts_has_no_column_for_them) {
    const TemporaryFolder folder;
    RawWriter writer{folder.file("raw.csv"), {}, false};
    writer.write({.detuning_lambda = 0.0});
    EXPECT_EQ(message_of<FormatError>([&] { writer.write({.half = 1, .bias_sign = -1, .edge_offset_ticks = -3}); }),
              "half 1 cannot be logged: edge_offset_ticks is -3, and the log has no column for it");
    writer.close();
    EXPECT_EQ(content_of(folder.file("raw.csv")).find("edge"), std::string::npos);
    EXPECT_FALSE(RawReader{folder.file("raw.csv")}.header().has_edge_offset);
}

TEST(RawLog, with_shifts_says_how_fast_the_timer_runs) {
    const TemporaryFolder folder;
    RawColumns columns;
    columns.has_edge_offset = true;
    for (const double bad : {0.0, 0.5, 1e16, std::numeric_limits<double>::quiet_NaN()}) {
        columns.timer_hz = bad;
        const std::string message = message_of<FormatError>([&] {
            RawWriter{folder.file("raw.csv"), {}, false, columns};
        });
        expect_contains(message, "timer_hz");
    }
    columns.timer_hz = 1e7;
    RawWriter writer{folder.file("raw.csv"), {{"note", "x"}}, false, columns};
    writer.write({.counts = 151, .edge_offset_ticks = -83});
    writer.write({.half = 1, .counts = -150, .bias_sign = -1, .edge_offset_ticks = 41});
    writer.close();
    EXPECT_EQ(content_of(folder.file("raw.csv")),
              "# format_version = 3\n# note = x\n# timer_hz = "
              "10000000\nhalf,bias_sign,mode,counts,loop_closed,edge_offset_ticks\n"
              "0,1,1,151,1,-83\n1,-1,1,-150,1,41\n");
}

TEST(RawReader, takes_shifts_only_with_the_timer_that_they_count) {
    const std::string table = "half,bias_sign,mode,counts,loop_closed,edge_offset_ticks\n0,1,1,150,1,-7\n";
    const auto rows = read_text("# timer_hz = 1e7\n" + table);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].edge_offset_ticks, -7);
    EXPECT_EQ(header_of("# timer_hz = 1e7\n# timer_hz = 10000000\n" + table).timer_hz, 1e7);
    expect_contains(complaint(table), "timer_hz is missing");
    for (const char* bad : {"0", "-1", "1e16", "fast", "nan"}) {
        expect_contains(complaint(std::string{"# timer_hz = "} + bad + "\n" + table), "allowed is");
    }
    expect_contains(complaint("# timer_hz = 1e7\n# timer_hz = 1e6\n" + table), "timer_hz = 1e6");
    // Without the column it is a note like any other.
    EXPECT_EQ(header_of("# timer_hz = fast\n" + names + "0,1,1,150,1\n").settings.size(), 1u);
}

TEST(RawReader, a_shift_is_an_integer_of_32_bits) {
    const std::string head = "# timer_hz = 1e7\nhalf,bias_sign,mode,counts,loop_closed,edge_offset_ticks\n0,1,1,150,1,";
    EXPECT_EQ(read_text(head + "-2147483648\n")[0].edge_offset_ticks, std::numeric_limits<std::int32_t>::min());
    for (const char* bad : {"2147483648", "0.5", "", "x"}) {
        expect_contains(complaint(head + bad + "\n"), "edge_offset_ticks");
    }
}
