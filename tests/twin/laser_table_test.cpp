#include <zlg/twin/laser_table.hpp>

#include <zlg/twin/laser_zones.hpp>

#include <laser/laser_grid.hpp>

#include "test.hpp"

namespace zlg::twin::laser_table_test {

// Largest difference of two answers, in parts of the centre intensity and of the bias at the table's largest field.
double difference(const LaserTable& table, double perimeter_lambda, double field_g) {
    const FourWave& exact = table.exact();
    const LaserLight a = table.at(perimeter_lambda, field_g);
    const LaserLight b = exact.at(perimeter_lambda, field_g);
    const double intensity = std::max({std::abs(a.left.cw - b.left.cw), std::abs(a.left.ccw - b.left.ccw),
                                       std::abs(a.right.cw - b.right.cw), std::abs(a.right.ccw - b.right.ccw)});
    const double bias_hz =
        std::max(std::abs(a.left.bias_hz - b.left.bias_hz), std::abs(a.right.bias_hz - b.right.bias_hz));
    const double whole_hz = std::abs(exact.at(0.0, table.max_field_g()).left.bias_hz);
    return std::max(intensity / exact.centre_intensity(), bias_hz / whole_hz);
}

double worst_at_random(const LaserTable& table, int n) {
    std::mt19937_64 random{3};
    std::uniform_real_distribution<double> perimeter{-3.0, 3.0};
    std::uniform_real_distribution<double> field{-table.max_field_g(), table.max_field_g()};
    double worst = 0.0;
    for (int k = 0; k < n; ++k) worst = std::max(worst, difference(table, perimeter(random), field(random)));
    return worst;
}

struct TabledLaser {
    const char* name;
    LaserConfig config;
    double max_field_g;
};

const TabledLaser cases[] = {
    {"default", {}, 16.5},
    {"20 G", {}, 22.0},
    {"full cross-saturation", {.opposite_sigma_coupling = 1.0}, 16.5},
    {"dark middle", {.gain_loss_ratio = 1.1}, 16.5},
    {"high gain", {.gain_loss_ratio = 1.4}, 16.5},
    {"unequal isotopes", {.upper_isotope_ratio = 0.465}, 16.5},
    {"narrow line", {.homogeneous_half_width_hz = 80e6}, 16.5},
    {"one isotope", {.gain_loss_ratio = 1.1, .isotope_shift_hz = 0.0}, 16.5},
};

TEST(LaserTable, ErrsByLessThanOneTenThousandthAnywhereAndSaysByHowMuch) {
    for (const TabledLaser& c : cases) {
        const LaserTable table{c.config, c.max_field_g};
        EXPECT_LE(table.error(), LaserTable::aimed_error) << c.name;
        // The points of its own check are not all points.
        EXPECT_LE(worst_at_random(table, 20000), 3.0 * LaserTable::aimed_error) << c.name;
    }
}

TEST(LaserTable, KinksStaySharpAtZoneEdges) {
    const LaserTable table{LaserConfig{}, 22.0};
    for (const double field_g : {-20.0, -7.3, 11.1, 15.0, 21.9}) {
        for (const LaserZone& zone : laser_zones(table.exact(), field_g, -0.5, 0.5)) {
            for (const double off : {-1e-3, -1e-5, -1e-7, 0.0, 1e-7, 1e-5, 1e-3}) {
                EXPECT_LE(difference(table, zone.from_lambda + off, field_g), 3.0 * LaserTable::aimed_error)
                    << field_g << " G, edge " << zone.from_lambda;
            }
            // Off the edge by more than the table's error, the right waves are lit.
            EXPECT_EQ(table.at(zone.from_lambda + 1e-5, field_g).lit(), zone.lit);
            EXPECT_EQ(table.at(zone.to_lambda - 1e-5, field_g).lit(), zone.lit);
        }
    }
}

TEST(LaserTable, TheBorderOfModesAndTheEndsOfTheFieldBelongToIt) {
    const LaserTable table{LaserConfig{}, 15.0};
    for (const double p : {-0.75, -0.25, -0.0, 0.0, 0.25, 0.5, 0.75, 1e6 + 0.25}) {
        for (const double field_g : {-15.0, -0.0, 0.0, 15.0}) {
            EXPECT_LE(difference(table, p, field_g), LaserTable::aimed_error) << p << " " << field_g;
        }
    }
}

TEST(LaserTable, BeyondItsFieldAnswersExactly) {
    const LaserTable table{LaserConfig{}, 15.0};
    EXPECT_EQ(difference(table, 0.1, 30.0), 0.0);
    EXPECT_EQ(difference(table, -0.23, -15.001), 0.0);
}

// Bicubic: half the step leaves a sixteenth of the error.
TEST(LaserTable, ConvergesWithTheFourthPowerOfItsStep) {
    const Gas gas{LaserConfig{}};
    const double max_shift = gas.shift_of(15.0);
    const double coarse = LaserGrid{gas, max_shift, 40, 16}.error(gas).bias_hz;
    const double fine = LaserGrid{gas, max_shift, 80, 32}.error(gas).bias_hz;
    EXPECT_NEAR(coarse / fine, 16.0, 2.0);
}

TEST(LaserTable, RefusesAFieldThatIsNone) {
    for (const double bad : {0.0, -15.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW(LaserTable(LaserConfig{}, bad), std::invalid_argument);
    }
    EXPECT_THROW(LaserTable(LaserConfig{.gain_loss_ratio = 7.0}, 15.0), std::invalid_argument);
}

// A line that is a thousandth of the free spectral range, and a field that crosses it some hundred times, need more
// points than the table may have.
TEST(LaserTable, RefusesWhatItCannotTabulate) {
    const LaserConfig sharp{.perimeter_m = 0.03, .homogeneous_half_width_hz = 9.07e6};
    EXPECT_THROW(LaserTable(sharp, 16.5), std::runtime_error);
    EXPECT_THROW(LaserTable(LaserConfig{}, 1e5), std::runtime_error);
}

}  // namespace zlg::twin::laser_table_test
