// The column coil_ua of raw logs, in both formats, and logs without it.

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
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

std::vector<HalfRecord> halves_with_coil(const std::vector<std::int32_t>& currents_ua) {
    std::vector<HalfRecord> all(currents_ua.size());
    for (std::size_t h = 0; h < all.size(); ++h) {
        all[h].half = static_cast<std::int64_t>(h);
        all[h].bias_sign = h % 2 == 0 ? std::int8_t{1} : std::int8_t{-1};
        all[h].counts = 150;
        all[h].coil_ua = currents_ua[h];
    }
    return all;
}

void write_coil_log(const std::string& path, const std::vector<HalfRecord>& rows, bool has_coil) {
    RawColumns columns = all_raw_columns;
    columns.has_coil = has_coil;
    RawWriter writer{path, {}, false, columns};
    for (const HalfRecord& row : rows) writer.write(row);
    writer.close();
}

class RawCoil : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(RawLog, RawCoil, testing::Values("raw.csv", "raw.h5"));

TEST_P(RawCoil, comes_back_as_it_was_written) {
    const TemporaryFolder folder;
    const auto rows = halves_with_coil({1'000'976, -999'512, 0, 7, std::numeric_limits<std::int32_t>::max(),
                                        std::numeric_limits<std::int32_t>::min()});
    write_coil_log(folder.file(GetParam()), rows, true);
    EXPECT_TRUE(RawReader{folder.file(GetParam())}.header().has_coil);
    EXPECT_EQ(rows_of(folder.file(GetParam())), rows);
}

TEST_P(RawCoil, is_0_in_a_log_without_the_column_and_our_own_have_it_where_it_is_asked_for) {
    const TemporaryFolder folder;
    write_coil_log(folder.file(GetParam()), halves_with_coil({1'000'000, -1'000'000}), false);
    EXPECT_FALSE(RawReader{folder.file(GetParam())}.header().has_coil);
    for (const HalfRecord& row : rows_of(folder.file(GetParam()))) EXPECT_EQ(row.coil_ua, 0);
    EXPECT_FALSE(all_raw_columns.has_coil);
}

TEST(RawCoilCsv, is_whole_microamperes) {
    const TemporaryFolder folder;
    for (const std::string bad : {"1.5", "2147483648", "nan", "1e6"}) {
        std::ofstream{folder.file("raw.csv")} << "half,bias_sign,mode,counts,loop_closed,coil_ua\n0,1,1,150,1,1000000\n"
                                              << "1,-1,1,-150,1," << bad << "\n";
        const auto message = message_of<FormatError>([&] { (void)rows_of(folder.file("raw.csv")); });
        EXPECT_NE(message.find("row 2, column 'coil_ua': '" + bad + "'"), std::string::npos) << message;
    }
}

}  // namespace
