// The column fringe of raw logs: what may stand in it, in both formats, and old logs without it.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>
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

TEST_P(RawFringe, our_own_logs_have_it_where_it_is_asked_for) {
    const TemporaryFolder folder;
    RawWriter writer{folder.file(GetParam()), {}, false};
    writer.write(halves_with_fringe({7.0f})[0]);
    writer.close();
    EXPECT_FALSE(RawReader{folder.file(GetParam())}.header().has_fringe);
}

TEST_P(RawFringe, out_of_range_is_refused_by_a_writer) {
    const TemporaryFolder folder;
    for (const float bad : {-1.0f, 65536.0f, 0.5f}) {
        const std::string file = folder.file(std::to_string(bad) + GetParam());
        const auto message = message_of<FormatError>([&] { write_fringe_log(file, halves_with_fringe({3.0f, bad})); });
        EXPECT_NE(message.find("half 1 cannot be logged: fringe = "), std::string::npos) << message;
        EXPECT_NE(message.find("is out of range; allowed is 0..65535, or nan where it is not known"),
                  std::string::npos);
    }
}

TEST(RawFringe, out_of_range_is_refused_with_row_and_value) {
    for (const std::string bad : {"-1", "65536", "0.5", "inf", "1e9"}) {
        const TemporaryFolder folder;
        std::ofstream{folder.file("raw.csv")}
            << "half,bias_sign,mode,counts,loop_closed,fringe\n0,1,1,5,1,65535\n1,-1,1,5,1," << bad << "\n";
        const auto message = message_of<FormatError>([&] { (void)rows_of(folder.file("raw.csv")); });
        EXPECT_NE(message.find("row 2, column 'fringe': '" + bad + "' is out of range; allowed is 0..65535"),
                  std::string::npos)
            << message;
    }
}

}  // namespace
