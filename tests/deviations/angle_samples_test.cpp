#include <zlg/deviations/angle_samples.hpp>

#include <zlg/deviations/averaging.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>

#include "temporary_folder.hpp"

namespace zlg::deviations::angle_samples_test {

class AngleSamplesTest : public testing::Test {
protected:
    // Increments of white noise; every hundredth tick was bridged and is far off.
    std::string log(const std::string& name, int n) {
        const std::string path = folder_.file(name);
        logs::AngleWriter writer(path, 0.005, {}, false);
        std::mt19937_64 engine(31);
        std::normal_distribution<double> normal(0.1, 2.0);
        for (int k = 0; k < n; ++k) {
            const bool bridged = k % 100 == 50;
            values_.push_back(bridged ? std::nan("") : normal(engine));
            writer.write({.tick = k,
                          .dtheta_arcsec = 7.0,
                          .dtheta_final_arcsec = bridged ? 1e5 : values_.back(),
                          .flags = bridged ? core::flag_interpolated : 0U});
        }
        writer.close();
        return path;
    }

    test::TemporaryFolder folder_;
    std::vector<double> values_;
};

TEST_F(AngleSamplesTest, stream_into_the_deviation_of_the_same_numbers_in_memory) {
    for (const char* name : {"angles.csv", "angles.h5"}) {
        values_.clear();
        auto samples = angle_samples(log(name, 40000));
        EXPECT_EQ(samples.what.kind, DataKind::increments);
        EXPECT_EQ(samples.what.unit, Unit::arcsec);
        EXPECT_DOUBLE_EQ(samples.what.rate_hz, 200.0);
        const auto factors = octave_factors(1024);
        DeviationStream stream({.what = samples.what, .kinds = {DeviationKind::oadev}, .factors = factors});
        read_into(stream, samples.source);
        EXPECT_EQ(stream.n_known(), 40000 - 400);
        const AngleRecord record(Series{.what = samples.what, .values = values_});
        const auto a = stream.curve(DeviationKind::oadev).points,
                   b = deviation(record, DeviationKind::oadev, factors).points;
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t k = 0; k < a.size(); ++k) {
            EXPECT_EQ(a[k].terms, b[k].terms);
            EXPECT_NEAR(a[k].deviation, b[k].deviation, 1e-12 * b[k].deviation);
        }
    }
}

// Through blocks of another length than the reader's.
TEST_F(AngleSamplesTest, are_those_of_the_rows) {
    for (const char* name : {"rows.csv", "rows.h5"}) {
        const std::string path = folder_.file(name);
        logs::AngleWriter writer(path, 0.01, {}, false);
        for (int k = 0; k < 40000; ++k)
            writer.write({.tick = k,
                          .dtheta_arcsec = 1.0 * k,
                          .dtheta_final_arcsec = -0.5 * k,
                          .flags = static_cast<std::uint32_t>(k % 7)});
        writer.close();
        for (const auto column : {AngleColumn::dtheta, AngleColumn::dtheta_final}) {
            auto samples = angle_samples(path, column, 3);
            EXPECT_DOUBLE_EQ(samples.what.rate_hz, 100.0);
            std::vector<double> values(1000);
            std::vector<std::uint8_t> valid(1000);
            int row = 0;
            while (const auto n = samples.source(values, valid))
                for (std::size_t k = 0; k < n; ++k, ++row) {
                    ASSERT_EQ(values[k], (column == AngleColumn::dtheta ? 1.0 : -0.5) * row);
                    ASSERT_EQ(valid[k], (row % 7) % 4 == 0 ? 1 : 0);
                }
            EXPECT_EQ(row, 40000);
        }
    }
}

TEST_F(AngleSamplesTest, end_with_a_complaint_where_a_row_is_not_good) {
    const auto path = folder_.file("bad.csv");
    std::ofstream(path) << "# tick_s = 0.01\ntick,t_s,dtheta_arcsec,dtheta_final_arcsec,sigma_arcsec,mode,flags\n"
                           "0,0.01,1,1,0,1,0\n1,0.02,nan,1,0,1,0\n";
    auto samples = angle_samples(path, AngleColumn::dtheta);
    std::vector<double> values(1);
    std::vector<std::uint8_t> valid(1);
    EXPECT_EQ(samples.source(values, valid), 1U);
    EXPECT_THROW((void)samples.source(values, valid), logs::FormatError);
}

TEST_F(AngleSamplesTest, keeps_what_is_not_said_to_be_missing) {
    auto samples = angle_samples(log("angles.h5", 1000), AngleColumn::dtheta, 0);
    std::vector<double> values(2000);
    std::vector<std::uint8_t> valid(2000, 9);
    ASSERT_EQ(samples.source(values, valid), 1000U);
    EXPECT_EQ(values[50], 7.0);
    EXPECT_EQ(valid[50], 1);
    EXPECT_EQ(samples.source(values, valid), 0U);
}

TEST_F(AngleSamplesTest, needs_a_log_that_says_how_long_a_tick_is) {
    EXPECT_THROW((void)angle_samples(folder_.file("none.csv")), logs::IoError);
    const auto path = folder_.file("bare.csv");
    std::ofstream(path) << "tick,t_s,dtheta_arcsec,dtheta_final_arcsec,sigma_arcsec,mode,flags\n0,0.005,1,1,0,1,0\n";
    EXPECT_THROW((void)angle_samples(path), logs::FormatError);
}

}  // namespace zlg::deviations::angle_samples_test
