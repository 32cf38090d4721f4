// The column fringe of raw logs: what may stand in it, in both formats, and old logs without it.

#include <zlg/logs/error.hpp>
#include <zlg/logs/raw_log.hpp>

#include "raw_rows.hpp"
#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;
using zlg::core::HalfRecord;

namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

std::vector<HalfRecord> halves_with_fringe(const std::vector<float>& fringes) {
    std::vector<HalfRecord> all(fringes.size());
    for (std::size_t h = 0; h < all.size(); ++h) {
        all[h].half = static_cast<std::int64_t>(h);
        all[h].bias_sign = h % 2 == 0 ? std::int8_t{1} : std::int8_t{-1};
        all[h].counts = 150;
        all[h].fringe = fringes[h];
    }
    return all;
}

void write_fringe_log(const std::string& path, const std::vector<HalfRecord>& rows, bool has_fringe = true) {
    RawColumns columns = all_raw_columns;
    columns.has_fringe = has_fringe;
    RawWriter writer{path, {}, false, columns};
    for (const HalfRecord& row : rows) writer.write(row);
    writer.close();
}

class RawFringe : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(RawLog, RawFringe, testing::Values("raw.csv", "raw.h5"));

TEST_P(RawFringe, comes_back_as_it_was_written) {
    const TemporaryFolder folder;
    const auto rows = halves_with_fringe({0.0f, 1.0f, unknown, 65535.0f, 32768.0f, unknown});
    write_fringe_log(folder.file(GetParam()), rows);
    EXPECT_TRUE(RawReader{folder.file(GetParam())}.header().has_fringe);
    EXPECT_EQ(rows_of(folder.file(GetParam())), rows);
}

TEST_P(RawFringe, is_not_known_in_a_log_without_the_column) {
    const TemporaryFolder folder;
    write_fringe_log(folder.file(GetParam()), halves_with_fringe({1.0f, 2.0f}), false);
    EXPECT_FALSE(RawReader{folder.file(GetParam())}.header().has_fringe);
    for (const HalfRecord& row : rows_of(folder.file(GetParam()))) EXPECT_TRUE(std::isnan(row.fringe));
}

TEST_P(RawFringe, out_of_range_is_refused_by_a_writer) {
    const TemporaryFolder folder;
    for (const float bad : {-1.0f, 65536.0f, 0.5f}) {
        const std::string file = folder.file(std::to_string(bad) + GetParam());
        const auto message = message_of<FormatError>([&] { write_fringe_log(file, halves_with_fringe({3.0f, bad})); });
        expect_contains(message, "half 1 cannot be logged: fringe = ");
        expect_contains(message, "is out of range; allowed is 0..65535, or nan where it is not known");
    }
}

}  // namespace
