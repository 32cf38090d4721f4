#include "csv/line_reader.hpp"

#include <zlg/logs/error.hpp>

#include "temporary_folder.hpp"

namespace zlg::logs::line_reader_test {

std::vector<std::string> lines_of(const std::string& text) {
    static const test::TemporaryFolder folder;
    LineReader reader{folder.write("lines.txt", text)};
    std::vector<std::string> lines;
    for (std::string_view line; reader.next(line);) lines.emplace_back(line);
    if (!reader.terminated()) lines.emplace_back("no end");
    return lines;
}

using Lines = std::vector<std::string>;

TEST(LineReader, every_end_of_a_line_ends_one) {
    const Lines both{"a,b", "", "c"};
    EXPECT_EQ(lines_of("a,b\n\nc\n"), both);
    EXPECT_EQ(lines_of("a,b\r\n\r\nc\r\n"), both);
    EXPECT_EQ(lines_of("a,b\r\rc\r"), both);
    EXPECT_EQ(lines_of("a,b\n\rc\r\n"), both);
    EXPECT_EQ(lines_of("a,b\r\r\nc\n"), (Lines{"a,b", "c"}));  // CRLF that was written as CRLF once more
    EXPECT_EQ(lines_of("a\rb"), (Lines{"a", "b", "no end"}));
    EXPECT_EQ(lines_of("a\n\r\n\r"), (Lines{"a", "", ""}));
    EXPECT_EQ(lines_of(""), Lines{});
}

TEST(LineReader, ends_at_the_border_of_its_buffer_are_whole) {
    const std::size_t size = LineReader::max_line_bytes;
    for (const char* end : {"\n", "\r\n", "\r", "\r\r\n"})
        for (std::size_t before = size - 5; before < size; ++before) {
            const std::string first(before - 10, 'x');
            EXPECT_EQ(lines_of("012345678\n" + first + end + "y" + end), (Lines{"012345678", first, "y"})) << before;
        }
}

TEST(LineReader, a_line_that_is_longer_than_its_buffer_is_refused) {
    EXPECT_THROW((void)lines_of(std::string(LineReader::max_line_bytes + 1, '1')), FormatError);
}

TEST(LineReader, many_short_lines_are_linear_with_any_end) {
    EXPECT_EQ(lines_of(std::string(3'000'000, '\r')).size(), 3'000'000u);
}

}  // namespace zlg::logs::line_reader_test
