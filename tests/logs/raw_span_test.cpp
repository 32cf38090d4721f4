// The column span of raw logs: what may stand in it, in both formats, and old logs without it.

#include <zlg/logs/error.hpp>
#include <zlg/logs/raw_log.hpp>

#include "raw_rows.hpp"
#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;
using zlg::core::HalfRecord;

namespace {

// Halves 0 .. 9, of which `missed` before half 6 have no frame; half 6 has this span.
std::vector<HalfRecord> halves_with_span(int missed, std::int32_t span) {
    std::vector<HalfRecord> all(10);
    for (int h = 0; h < 10; ++h) {
        HalfRecord& r = all[static_cast<std::size_t>(h)];
        r.half = h;
        r.bias_sign = h % 2 == 0 ? std::int8_t{1} : std::int8_t{-1};
        r.valid = !(h < 6 && h >= 6 - missed);
        r.counts = r.valid ? 100 + h : 0;
    }
    all[6].span = span;
    return all;
}

void write_span_log(const std::string& path, const std::vector<HalfRecord>& rows,
                    const RawColumns& columns = all_raw_columns) {
    RawWriter writer{path, {}, false, columns};
    for (const HalfRecord& row : rows) writer.write(row);
    writer.close();
}

class RawSpan : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(RawLog, RawSpan, testing::Values("raw.csv", "raw.h5"));

TEST_P(RawSpan, comes_back_as_it_was_written) {
    const TemporaryFolder folder;
    const auto rows = halves_with_span(4, 5);
    write_span_log(folder.file(GetParam()), rows);
    EXPECT_TRUE(RawReader{folder.file(GetParam())}.header().has_span);
    EXPECT_EQ(rows_of(folder.file(GetParam())), rows);
}

TEST_P(RawSpan, is_one_in_a_log_without_the_column) {
    const TemporaryFolder folder;
    RawColumns columns = all_raw_columns;
    columns.has_span = false;
    const auto rows = halves_with_span(4, 1);
    write_span_log(folder.file(GetParam()), rows, columns);
    EXPECT_FALSE(RawReader{folder.file(GetParam())}.header().has_span);
    EXPECT_EQ(rows_of(folder.file(GetParam())), rows);
    const auto message = message_of<FormatError>(
        [&] { write_span_log(folder.file(std::string{"b"} + GetParam()), halves_with_span(4, 5), columns); });
    EXPECT_EQ(message, "half 6 cannot be logged: span is 5, and the log has no column for it");
}

// The spoilt row is the one that is named, wherever the blocks of a reader end.
TEST_P(RawSpan, goes_over_no_more_than_the_missed_rows_before_it) {
    struct Case {
        std::vector<HalfRecord> rows;
        std::string value, allowed;
    };
    std::vector<Case> cases{{halves_with_span(4, 6), "6", "1..5"}, {halves_with_span(0, 2), "2", "1..1"},
                            {halves_with_span(3, 0), "0", "1..4"}, {halves_with_span(3, -7), "-7", "1..4"},
                            {halves_with_span(5, 4), "4", "1..3"}, {halves_with_span(5, 4), "4", "1..2"}};
    cases[4].rows[3].counts = 1;  // no missed row: it has counts
    cases[4].allowed = "1..3";
    cases[5].rows[4].valid = true;
    for (const Case& c : cases) {
        const TemporaryFolder folder;
        write_span_log(folder.file(GetParam()), c.rows);
        const std::string message = message_of<FormatError>([&] { (void)rows_of(folder.file(GetParam())); });
        expect_contains(message, "span");
        expect_contains(message, "'" + c.value + "'");
        expect_contains(message, "allowed is " + c.allowed + ":");
        expect_contains(message, "row 7");
    }
}

TEST(RawSpanRows, go_on_from_block_to_block) {
    const TemporaryFolder folder;
    std::vector<HalfRecord> rows(70'000);
    for (std::size_t h = 0; h < rows.size(); ++h) {
        rows[h].half = static_cast<std::int64_t>(h);
        rows[h].bias_sign = h % 2 == 0 ? std::int8_t{1} : std::int8_t{-1};
        rows[h].valid = h < 10 || h >= 69'000;
    }
    rows[69'000].span = 68'991;
    write_span_log(folder.file("raw.h5"), rows);
    EXPECT_EQ(rows_of(folder.file("raw.h5")).size(), rows.size());
    rows[69'000].span = 68'992;
    write_span_log(folder.file("long.h5"), rows);
    EXPECT_THROW((void)rows_of(folder.file("long.h5")), FormatError);
}

}  // namespace
