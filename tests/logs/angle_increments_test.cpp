#include <zlg/logs/angle_increments.hpp>

#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>

#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;

namespace {

class AngleIncrementsTest : public testing::Test {
protected:
    std::string log(const std::string& name, int rows) const {
        const std::string path = folder_.file(name);
        AngleWriter writer(path, 0.01, {}, false);
        for (int k = 0; k < rows; ++k)
            writer.write({.tick = k,
                          .dtheta_arcsec = 1.0 * k,
                          .dtheta_final_arcsec = -0.5 * k,
                          .flags = static_cast<std::uint32_t>(k % 7)});
        writer.close();
        return path;
    }

    TemporaryFolder folder_;
};

TEST_F(AngleIncrementsTest, are_those_of_the_rows) {
    for (const char* name : {"a.csv", "a.h5"})
        for (const auto column : {AngleColumn::dtheta, AngleColumn::dtheta_final}) {
            const auto path =
                log(std::string(column == AngleColumn::dtheta ? "delivered_" : "final_").append(name), 40000);
            AngleIncrements increments(path, column);
            EXPECT_DOUBLE_EQ(increments.tick_s().value(), 0.01);
            std::vector<double> values(1000);
            std::vector<std::uint32_t> flags(1000);
            int row = 0;
            while (const auto n = increments.read(values, flags))
                for (std::size_t k = 0; k < n; ++k, ++row) {
                    ASSERT_EQ(values[k], (column == AngleColumn::dtheta ? 1.0 : -0.5) * row);
                    ASSERT_EQ(flags[k], static_cast<std::uint32_t>(row % 7));
                }
            EXPECT_EQ(row, 40000);
        }
}

TEST_F(AngleIncrementsTest, need_a_log_that_is_there) {
    EXPECT_THROW(AngleIncrements(folder_.file("none.h5"), AngleColumn::dtheta), IoError);
    const auto path = folder_.file("other.csv");
    std::ofstream(path) << "a,b\n1,2\n";
    EXPECT_THROW(AngleIncrements(path, AngleColumn::dtheta), FormatError);
}

TEST_F(AngleIncrementsTest, end_with_a_complaint_where_a_row_is_not_good) {
    const auto path = folder_.file("bad.csv");
    std::ofstream(path)
        << "tick,t_s,dtheta_arcsec,dtheta_final_arcsec,sigma_arcsec,mode,flags\n0,0.01,1,1,0,1,0\n1,0.02,nan,1,0,1,0\n";
    AngleIncrements increments(path, AngleColumn::dtheta);
    EXPECT_FALSE(increments.tick_s().has_value());
    std::vector<double> values(1);
    std::vector<std::uint32_t> flags(1);
    EXPECT_EQ(increments.read(values, flags), 1U);
    EXPECT_THROW((void)increments.read(values, flags), FormatError);
}

}  // namespace
