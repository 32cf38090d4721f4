#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <zlg/logs/error.hpp>
#include <zlg/logs/text_columns.hpp>

#include "temporary_folder.hpp"

namespace zlg::logs::text_columns_test {

class TextColumns : public ::testing::Test {
protected:
    std::string write(const std::string& text) {
        const std::string path = folder_.file("columns.txt");
        std::ofstream{path, std::ios::binary} << text;
        return path;
    }
    std::string complaint(const std::string& text, const TextLayout& layout) {
        return zlg::test::refusal_by<FormatError>([&] { (void)read_text_columns(write(text), layout); });
    }

private:
    zlg::test::TemporaryFolder folder_;
};

// A table in one of its dialects, and what is asked for of it.
struct Case {
    const char* text;
    std::vector<std::int64_t> columns;
    std::vector<std::vector<double>> expected;
};

TEST_F(TextColumns, separator_and_decimal_mark_are_recognised_together) {
    const std::vector<Case> cases{
        {"  1 2\t3\n4 5  6\r\n+7 8 -9e-1\n", {3, 1}, {{3.0, 6.0, -0.9}, {1.0, 4.0, 7.0}}},
        {"0,0000;0,004178;24,5\n0,0100;-0,5;24,25\n", {2, 3}, {{0.004178, -0.5}, {24.5, 24.25}}},
        {"0,0000\t0,004178\t24,5\n0,0100\t-0,5\t24,25\n", {2}, {{0.004178, -0.5}}},
        {"0,0000 0,004178 24,5\n0,0100   -0,5\t24,25\n", {2}, {{0.004178, -0.5}}},
        {"0.5;1.25;7\n-1.5E-03;3;8\n", {1, 3}, {{0.5, -0.0015}, {7.0, 8.0}}},
        {"0.5 , 1.25 , 7\n-1.5 , 3 , 8\n", {2}, {{1.25, 3.0}}},
        {"\"0,5\",\"1,25\"\n\"-1,5\",\"3\"\n", {2}, {{1.25, 3.0}}},
        {"0.5|1.25\n1|2\n", {2}, {{1.25, 2.0}}},
        {"\xEF\xBB\xBFt;x\r\n0;1,5\r\n1;2,5\r\n", {2}, {{1.5, 2.5}}},
        {"5,5\n6\n7,25\n", {1}, {{5.5, 6.0, 7.25}}},
        {"1;2,5;\n3;4,5;\n", {2}, {{2.5, 4.5}}},
        {"a;b\n1;2,5;\n3;4,5;\n", {2}, {{2.5, 4.5}}},
        {"1,5E-03;1\n2,5e+2;2\n", {1}, {{0.0015, 250.0}}},
        {"2024-01-02 12:00:00,0.5\n2024-01-02 12:00:01,0.75\n", {2}, {{0.5, 0.75}}},
        {"02.01.2024 12:00:00\t0,5\n02.01.2024 12:00:01\t0,75\n", {2}, {{0.5, 0.75}}},
        {"02.01.2024 12:00:00;0,5\n02.01.2024 12:00:01;0,75\n", {2}, {{0.5, 0.75}}},
        {"sep=;\r\ntime;rate\r\n0;1,5\r\n1;2,5\r\n", {2}, {{1.5, 2.5}}},
        {"1,5,-3\n2,-7,4\n", {2}, {{5.0, -7.0}}},
        {"k,n,m\n1,5,3\n2,7,4\n", {2}, {{5.0, 7.0}}},
        {"time,rate\n0,5\n1,7\n", {2}, {{5.0, 7.0}}},
        {"rate\n0,5\n1,75\n", {1}, {{0.5, 1.75}}},
        {"0\t\t3\n1\t5\t6\n", {3}, {{3.0, 6.0}}},
    };
    for (const Case& each : cases)
        EXPECT_EQ(read_text_columns(write(each.text), {.columns = each.columns}), each.expected) << each.text;
}

TEST_F(TextColumns, what_can_be_read_in_two_ways_is_refused_with_both) {
    for (const char* text : {"0,01,0,004178\n0,02,0,004179\n", "1,0,25\n2,1,75\n", "-1,5,-2,75\n1,25,3,5\n"})
        zlg::test::expect_contains(complaint(text, {.columns = {2}}), "fewer columns with decimal commas");
    zlg::test::expect_contains(complaint("a,b\n0,01,0,004178\n", {.columns = {2}}), "names 2 columns");
    for (const char* text :
         {"0,5\n1,75\n", "0,004178\n0,004177\n", "1,5\n1,75\n2", "1,234.5\n2,345.5\n", "1 234,5\n2 345,5\n"}) {
        const std::string why = complaint(text, {.columns = {1}});
        EXPECT_NE(why.find("can be read as separator"), std::string::npos) << text << why;
        EXPECT_NE(why.find(", or as "), std::string::npos) << text << why;
        EXPECT_NE(why.find("say which by analysis.separator="), std::string::npos) << text << why;
    }
    EXPECT_EQ(read_text_columns(write("0,5\n1,75\n"), {.columns = {1}, .mark = TextMark::comma})[0],
              (std::vector<double>{0.5, 1.75}));
    EXPECT_EQ(read_text_columns(write("0,5\n1,75\n"), {.columns = {1}, .separator = TextSeparator::comma})[0],
              (std::vector<double>{0.0, 1.0}));
    zlg::test::expect_contains(complaint("a 5,7\nb 5,8\n", {.columns = {2}}), ", or as ");
    zlg::test::expect_contains(complaint("rate, deg/h\n0,5\n0,7\n", {.columns = {1}}), ", or as ");
}

// Nothing but a header that names columns, or numbers with points, shows that a comma between digits parts columns.
TEST_F(TextColumns, a_fraction_between_commas_is_no_column) {
    const std::vector<std::pair<const char*, std::int64_t>> cases{
        {"0,0000E+00,1,5312E+01\n1,0000E-02,1,5313E+01\n", 2},
        {"0,0D+00,1,5D+01\n1,0D-02,1,6D+01\n", 3},
        {"2024-01-02 00:00:00.05,14,4821\n2024-01-02 00:00:00.10,14,4822\n", 2},
        {"2024-01-02 00:00:00 14,4821\n2024-01-02 00:00:01 14,4822\n", 2},
        {"2024-01-02 00:00:00,050,14\n2024-01-02 00:00:00,100,15\n", 2},
        {"2024-01-02 00:00:00,050,14.5\n2024-01-02 00:00:00,100,14.6\n", 2},
        {"time,rate,deg/s\n00:00:00,050,14.5\n00:00:00,100,14.6\n", 2},
        {"a.log,14,4821\na.log,14,4822\n", 3},
        {"2.1,14,4821\n2.1,14,4822\n", 3},
        {"v1.2.3,14,4821\nv1.2.3,14,4822\n", 2},
        {"# rate, deg/h\n15,0312\n15,0313\n", 2},
        {"# rate in degrees per hour, of Monday\n15,0312\n15,0313\n", 2},
        {"# t,x\n15,0312\n15,0313\n", 2},
        {"rate, deg/h\n15,0312\n15,0313\n", 2},
        {"rate,deg/h\n15,0312\n15,0313\n", 2},
        {"rate,[deg/h]\n15,0312\n15,0313\n", 2},
        {"rate,dps\n15,0312\n15,0313\n", 2},
        {"time,rate,ok,note\n00:00:00,050,14.5,1,\n00:00:00,100,14.6,1,\n", 2},
        {"rate,note\n14,4821,\n14,4822,\n", 1},
        {"name0,\n5,1234,\n6,1245,\n", 1},
        {"1.234,56\n1.235,78\n", 2},
        {"1\xC2\xA0"
         "234,56\n1\xC2\xA0"
         "235,78\n",
         2},
        {"1'234,56\n1'235,78\n", 2},
        {"\xE2\x88\x92"
         "15,0312\n\xE2\x88\x92"
         "15,0313\n",
         2},
        {"rate=15,0312\nrate=15,0313\n", 2},
        {"k,15,0312\nl,15,0313\n", 3},
    };
    for (const auto& [text, column] : cases) {
        const std::string why = complaint(text, {.columns = {column}});
        EXPECT_NE(why.find("fewer columns with decimal commas"), std::string::npos) << text << why;
        EXPECT_EQ(complaint(text, {.columns = {column}, .separator = TextSeparator::comma, .mark = TextMark::point}),
                  "")
            << text;
    }
    zlg::test::expect_contains(complaint("# rate, deg/h\n1,234.5\n2,345.5\n", {.columns = {2}}), "parted thousands");
}

// What is no number in its own dialect is not read in another one.
TEST_F(TextColumns, blanks_within_fields_part_no_columns) {
    for (const char* text :
         {"a\t25.5\t235\t15 286.0\na\t25.6\t236\t15 287.0\n",
          "02.01.2024 12:00\t25.5\t235\t15\xC2\xA0"
          "286.0\n02.01.2024 12:01\t25.6\t236\t15\xC2\xA0"
          "287.0\n",
          "0,x,7,1 234 567,5\n1,y,7,1 235 567,5\n", "A,1,5D1,1 234 567,5,B\nA,1,6D1,1 235 567,5,B\n"})
        for (const std::int64_t column : {2, 3, 4, 5}) {
            std::vector<double> read;
            try {
                read = read_text_columns(write(text), {.columns = {column}})[0];
            } catch (const FormatError&) {
                continue;
            }
            EXPECT_TRUE(read[0] == 25.5 || read[0] == 235.0) << text << column << ": " << read[0];
        }
    EXPECT_EQ(
        read_text_columns(write("2024-01-02 12:00:00,050 15.5\n2024-01-02 12:00:00,100 15.75\n"), {.columns = {3}})[0],
        (std::vector<double>{15.5, 15.75}));
}

TEST_F(TextColumns, integers_between_commas_are_columns_where_that_is_sure) {
    const std::vector<Case> cases{
        {"0.005,1203,1310\n0.010,1204,1311\n", {2}, {{1203.0, 1204.0}}},
        {"24.5,1203,1310\n24.6,1204,1311\n", {3}, {{1310.0, 1311.0}}},
        {"time [s],rate [deg/h]\n0,15\n1,16\n", {2}, {{15.0, 16.0}}},
        {",rate\n0,15\n1,16\n", {2}, {{15.0, 16.0}}},
        {"0, 15\n1, 16\n", {2}, {{15.0, 16.0}}},
        {"2024-01-02,15\n2024-01-03,16\n", {2}, {{15.0, 16.0}}},
        {"2024-01-02 12:00:00,98\n2024-01-02 12:00:01,101\n", {2}, {{98.0, 101.0}}},
        {"gyro1,1203\ngyro1,1204\n", {2}, {{1203.0, 1204.0}}},
        {"5,NaN\n6,7\n5,8\n", {1}, {{5.0, 6.0, 5.0}}},
        {"\"5\",\"7\"\n\"6\",\"8\"\n", {2}, {{7.0, 8.0}}},
    };
    for (const Case& each : cases)
        EXPECT_EQ(read_text_columns(write(each.text), {.columns = each.columns}), each.expected) << each.text;
    EXPECT_EQ(read_text_columns(write("0,15\n1,16\n"), {.columns = {2}, .mark = TextMark::point})[0],
              (std::vector<double>{15.0, 16.0}));
}

TEST_F(TextColumns, parted_thousands_are_never_numbers) {
    for (const char* text : {"1.234,5;2\n1.234,6;3\n", "1,234;5,678\n2,345;6,789\n", "1,234.5;7\n2,345.5;8\n",
                             "998.5\n999.5\n1,000.5\n", "999;1\n1.234;1\n2.345;1\n", "1 234,5;1\n1 235,5;2\n",
                             "1.234.567;1\n1.234.568;2\n", "1.234;1\n2.345;1\n", "12,345 67,890\n12,346 67,891\n"})
        EXPECT_NE(complaint(text, {.columns = {1}}), "") << text;
    for (const char* text :
         {"a 15 326.436 7\nb 14 722.784 8\n", "0.01,15,326.4\n0.02,14,722.7\n", "s s\n1.5 15 326\n2.5 14 722\n"})
        zlg::test::expect_contains(complaint(text, {.columns = {2}}), "column 2 being the thousands");
    for (const char* text :
         {"t n rate\n0.5 15 326.4\n1.5 14 722.7\n", "0.5 15  326.4\n1.5 14  722.7\n", "0.5 15 326.4\n1.5 14 99.7\n"})
        EXPECT_EQ(read_text_columns(write(text), {.columns = {2}})[0], (std::vector<double>{15.0, 14.0})) << text;
    EXPECT_EQ(read_text_columns(write("1,234;5,678\n2,345;6,789\n"), {.columns = {1}, .mark = TextMark::comma})[0],
              (std::vector<double>{1.234, 2.345}));
    EXPECT_EQ(read_text_columns(write("1,234;0,5\n2,345;1,5\n"), {.columns = {1}})[0],
              (std::vector<double>{1.234, 2.345}))
        << "the other column shows what the comma is";
    EXPECT_EQ(read_text_columns(write("1.234\n5.678\n"), {.columns = {1}})[0], (std::vector<double>{1.234, 5.678}));
}

TEST_F(TextColumns, a_mark_that_comes_late_is_the_only_one) {
    std::string whole;
    for (int k = 0; k < 1500; ++k) whole += "5;6\n";
    EXPECT_EQ(read_text_columns(write(whole + "5,5;6\n"), {.columns = {1}})[0].back(), 5.5);
    zlg::test::expect_contains(complaint(whole + "5,5;6\n5.5;6\n", {.columns = {1}}), ":1502, column 1: '5.5'");
    zlg::test::expect_contains(complaint(whole + "5;6;7\n", {.columns = {1}}),
                               ":1501: 3 fields, where the rows above have 2");
}

TEST_F(TextColumns, columns_have_the_names_of_the_header) {
    const TextTable table =
        read_text_table(write("\"time_s\", \"gyro z\", temp\n0, 5.5, 20\n1, 6.5, 21\n2, 7, 22\n"), {.columns = {2, 3}});
    EXPECT_EQ(table.columns[0].values.vector(), (std::vector<double>{5.5, 6.5, 7.0}));
    EXPECT_EQ(described(table.columns[0]), "column 2, 'gyro z'");
    EXPECT_EQ(described(table.columns[1]), "column 3, 'temp'");
    EXPECT_EQ(described(read_text_table(write("# t x\n0 1.5\n1 2.5\n"), {.columns = {2}}).columns[0]), "column 2, 'x'");
    zlg::test::expect_contains(complaint("time,gyro_z_dps\n0,5.5\n1,6.5\n", {.columns = {3}}),
                               "column 3, allowed is column 1..2");
}

// A thousand lines of a mebibyte, all their fields kept, were 29 gigabytes.
TEST_F(TextColumns, rows_of_many_fields_are_refused_and_not_kept) {
    std::string line;
    for (int k = 0; k < 100'001; ++k) line += "1;";
    zlg::test::expect_contains(complaint(line + "2\n3\n", {.columns = {1}}), ":1: 100002 fields, allowed is 100000");
    std::string row;
    for (int k = 0; k < 100; ++k) row += "1;";
    std::string ragged = row + "1\n";
    EXPECT_NE(complaint(ragged + ragged + line + "1\n", {.columns = {1}}), "");
    // More rows than the sample holds, each long: read to the end.
    std::string table;
    for (int k = 0; k < 200; ++k) {
        for (int c = 0; c < 10'000; ++c) table += "7;";
        table += std::to_string(k) + ".5\n";
    }
    EXPECT_EQ(read_text_columns(write(table), {.columns = {10001}})[0].back(), 199.5);
}

TEST_F(TextColumns, what_never_ends_is_refused_though_it_has_no_rows) {
    for (const char* text : {"# a comment\n", "\n", "1\n"}) {
        std::string endless;
        while (endless.size() < 3 << 20) endless += text;
        EXPECT_NE(complaint(endless, {.columns = {1}, .max_bytes = 1 << 20}).find("more than 1048576 bytes"),
                  std::string::npos)
            << text;
    }
    EXPECT_EQ(read_text_columns(write("# x\n1\n"), {.columns = {1}, .max_bytes = 6})[0], std::vector<double>{1.0});
    EXPECT_NE(complaint("# x\n1\n", {.columns = {1}, .max_bytes = 5}), "");
    EXPECT_THROW((void)read_text_columns("/dev/zero", {.columns = {1}}), FormatError);
}

// The property of the reader's buffer: what stands across the borders of its blocks comes out whole.
TEST_F(TextColumns, long_lines_and_short_ones_come_out_whole) {
    std::string text;
    std::vector<double> expected;
    for (int k = 0; k < 20; ++k) {
        for (const std::size_t blanks : {std::size_t(k) * 7001, (std::size_t{1} << 20) - 100}) {
            text += std::to_string(k) + ".25" + std::string(blanks, ' ') + "\n";
            expected.push_back(k + 0.25);
        }
    }
    EXPECT_EQ(read_text_columns(write(text), {.columns = {1}})[0], expected);
}

TEST_F(TextColumns, a_title_above_the_header_is_skipped_on_demand_alone) {
    const char* text = "Measurement of Monday\ntime;rate\n0;0,5\n1;0,75\n";
    zlg::test::expect_contains(complaint(text, {.columns = {2}}), "analysis.skip_lines");
    EXPECT_EQ(read_text_columns(write(text), {.columns = {2}, .skip_lines = 1})[0], (std::vector<double>{0.5, 0.75}));
}

TEST_F(TextColumns, comments_empty_lines_and_lines_to_skip_are_left_out) {
    const auto v = read_text_columns(write("% head\n\n1 1 1\n% more\n2 2 2\n3\n4\n"),
                                     {.columns = {1}, .comment = "%", .skip_lines = 2});
    EXPECT_EQ(v[0], (std::vector<double>{3.0, 4.0}));
}

TEST_F(TextColumns, nan_and_an_empty_field_are_missing) {
    const auto v = read_text_columns(write("1,2.5\n,5\nNaN,6\n7,\nNA,null\n"), {.columns = {1, 2}});
    EXPECT_TRUE(std::isnan(v[0][1]));
    EXPECT_TRUE(std::isnan(v[0][2]));
    EXPECT_TRUE(std::isnan(v[1][3]));
    EXPECT_TRUE(std::isnan(v[0][4]) && std::isnan(v[1][4]));
    EXPECT_EQ(v[1][1], 5.0);
}

TEST_F(TextColumns, what_is_wrong_is_named_with_its_place) {
    zlg::test::expect_contains(complaint("1 2\n3\n4 5\n", {.columns = {2}}),
                               ":2: 1 fields, where the rows above have 2");
    zlg::test::expect_contains(complaint("1,234,5\n1,5\n", {.columns = {1}}), ":2: 2 fields");
    zlg::test::expect_contains(complaint("1\nx7\n", {.columns = {1}}),
                               ":2, column 1: 'x7', allowed is a finite number");
    zlg::test::expect_contains(complaint("inf\n", {.columns = {1}}), "'inf'");
    zlg::test::expect_contains(complaint("# nothing\n", {.columns = {1}}), "no rows");
    EXPECT_NE(complaint("1\n", {.columns = {}}), "");
    EXPECT_NE(complaint("1\n", {.columns = {0}}), "");
    zlg::test::expect_contains(complaint("1.5\n2\n3\n", {.columns = {1}, .max_rows = 2}), "more than 2 rows");
    EXPECT_THROW((void)read_text_columns("/no/such/file", {.columns = {1}}), IoError);
}

// A table of known numbers in any dialect gives these numbers or is refused; never another number.
RC_GTEST_PROP(TextColumnsProperty, a_table_in_any_dialect_is_read_right_or_refused, ()) {
    const auto rows = *rc::gen::inRange<std::size_t>(2, 12);
    const auto columns = *rc::gen::inRange<std::size_t>(1, 5);
    const std::string separator = *rc::gen::element<std::string>(" ", "   ", "\t", ";", ",", "|", " ; ", ", ", " \t");
    const char mark = *rc::gen::element('.', ',');
    const bool has_header = *rc::gen::arbitrary<bool>();
    const bool ends_separated = separator.find_first_not_of(' ') != std::string::npos && *rc::gen::arbitrary<bool>();
    const bool has_crlf = *rc::gen::arbitrary<bool>();
    const int decimals = *rc::gen::inRange(0, 6);
    std::string text;
    const auto end_line = [&] { text += std::string{ends_separated ? separator : ""} + (has_crlf ? "\r\n" : "\n"); };
    for (std::size_t c = 0; has_header && c < columns; ++c)
        text += (c > 0 ? separator : "") + "name" + std::to_string(c);
    if (has_header) end_line();
    std::vector<std::vector<double>> table(columns);
    for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t c = 0; c < columns; ++c) {
            const double whole = *rc::gen::inRange(-2'000'000, 2'000'000);
            const double value = whole / std::pow(10.0, *rc::gen::inRange(0, 7));
            char number[64];
            std::snprintf(number, sizeof number, *rc::gen::arbitrary<bool>() ? "%.*f" : "%.*e", decimals, value);
            table[c].push_back(std::strtod(number, nullptr));
            std::string field = number;
            std::ranges::replace(field, '.', mark);
            text += (c > 0 ? separator : "") + field;
        }
        end_line();
    }
    const auto wanted = *rc::gen::inRange<std::size_t>(0, columns);
    const zlg::test::TemporaryFolder folder;
    const std::string path = folder.file("table.txt");
    std::ofstream{path, std::ios::binary} << text;
    std::vector<double> read;
    try {
        read = read_text_columns(path, {.columns = {static_cast<std::int64_t>(wanted) + 1}})[0];
    } catch (const FormatError&) {
        RC_TAG("refused");
        return;
    }
    RC_TAG("read");
    RC_ASSERT(read == table[wanted]);
}

TEST(EndOfText, a_file_ends_with_a_line_where_its_last_byte_is_a_line_feed) {
    const zlg::test::TemporaryFolder folder;
    EXPECT_TRUE(ends_with_a_line(folder.write("a", "1\n2\n")));
    EXPECT_TRUE(ends_with_a_line(folder.write("b", "1\r\n2\r\n")));
    EXPECT_FALSE(ends_with_a_line(folder.write("c", "1\n2")));
    EXPECT_TRUE(ends_with_a_line(folder.write("d", "")));
    EXPECT_TRUE(ends_with_a_line("/dev/zero")) << "nothing is read of what never ends";
}

}  // namespace zlg::logs::text_columns_test
