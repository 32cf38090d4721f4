// Both fidelities side by side: an averaged gyro with the constants of the laser, and the laser.

#include <zlg/twin/averaged_laser.hpp>
#include <zlg/twin/four_wave.hpp>

#include "laser_gyro.hpp"

namespace zlg::twin::twin_agreement_test {

TwinConfig with_constants_of_laser(TwinConfig config) {
    config.gyro = with_laser(config.gyro, config.laser.quadrature,
                             averaged_laser(FourWave{config.laser}, config.laser.bias_field_g));
    return config;
}

// Counts by quarters of a fringe, so that they resolve a fraction of what is compared.
TwinConfig fine(TwinConfig config) {
    config.laser.quadrature = Quadrature::x4;
    config.gyro.scale_arcsec = 3.263 / 4.0;
    return config;
}

// One switch to the other mode; the halves from the closing on.
std::vector<TwinHalf> after_switch(const TwinConfig& config, int n_halves) { return relocked(config, 190.0, n_halves); }

// The same detuning in both: the loop that decays as configured. Counts of a relock, from closing to rest.
TEST(TwinAgreement, CountsAgreeThroughARelockWithinTheResidualOfChi) {
    for (const double miss : {0.03, 0.1, 0.18}) {
        TwinConfig config = fine(as_laser(quiet_gyro()));
        config.perimeter.loop = Loop::exponential;
        config.perimeter.miss_lambda = miss;
        const auto laser = after_switch(config, 40);
        config.gyro.fidelity = Fidelity::averaged;
        const auto averaged = after_switch(with_constants_of_laser(config), 40);
        for (std::size_t h = 1; h < laser.size(); ++h) {
            EXPECT_EQ(laser[h].truth.detuning_end_lambda, averaged[h].truth.detuning_end_lambda);
            EXPECT_NEAR(laser[h].truth.false_relock_arcsec, averaged[h].truth.false_relock_arcsec,
                        0.01 * std::abs(averaged[h].truth.false_relock_arcsec) + 1e-6)
                << "miss " << miss << ", half " << h;
            EXPECT_NEAR(static_cast<double>(count_between(laser[h - 1], laser[h])),
                        static_cast<double>(count_between(averaged[h - 1], averaged[h])), 3.0)
                << "miss " << miss << ", half " << h;
        }
    }
}

// A tenth of a wavelength is where the laser's discriminator has grown by a fifth beyond the straight one.
TEST(TwinAgreement, TheLightAgreesForSmallDetuningsOnly) {
    const auto ratio = [](double dl) {
        const TwinConfig config = as_laser(held_gyro());
        Twin laser{config, Motion::rest()};
        TwinConfig straight = with_constants_of_laser(config);
        straight.gyro.fidelity = Fidelity::averaged;
        Twin averaged{straight, Motion::rest()};
        const auto signal = [&](Twin& twin) {
            const TwinHalf half = advance(twin, frame(true, 1, 150.0 + 80.0 * dl), 12).back();
            const double a = half.sensor.light_a[8];
            const double b = half.sensor.light_b[8];
            return (a - b) / (a + b);
        };
        return signal(laser) / signal(averaged);
    };
    EXPECT_NEAR(ratio(0.01), 1.0, 0.004);
    EXPECT_NEAR(ratio(0.05), 1.05, 0.01);
    EXPECT_NEAR(ratio(0.10), 1.24, 0.02);
    EXPECT_NEAR(ratio(0.20), 3.7, 0.1);
}

// Ten minutes of both without backscatter: rotation, drifts of both kinds and warming count the same.
TEST(TwinAgreement, TenMinutesCountTheSameWhereNothingLocks) {
    TwinConfig config = as_laser(quiet_gyro());
    config.drift.magnetic_arcsec_s = 0.7;
    config.drift.magnetic_thermal_arcsec_s = 0.7;
    config.drift.nonmagnetic_arcsec_s = 0.05;
    config.perimeter.expansion_lambda_per_c = 0.025;
    config.gyro.light_samples = 2;
    config.perimeter.tau_s = 0.05;  // fewer pieces
    Twin laser{config, Motion::sines(1000.0, {{500.0, 0.3, 0.0}})};
    config.gyro.fidelity = Fidelity::averaged;
    Twin averaged{with_constants_of_laser(config), Motion::sines(1000.0, {{500.0, 0.3, 0.0}})};
    std::int64_t apart_at_start = 0;
    for (int h = 0; h < 240'000; ++h) {
        const auto a = static_cast<std::int64_t>(laser.advance(frame(true, 1)).sensor.counter);
        const auto b = static_cast<std::int64_t>(averaged.advance(frame(true, 1)).sensor.counter);
        if (h == 0) apart_at_start = a - b;
        if (h % 10000 == 0 || h == 239'999) ASSERT_LE(std::abs(a - b - apart_at_start), 1) << h;
    }
}

// psi is pulled at each reversal, by an amount that depends on where it stands: a random walk where the rotation brings
// it to ever other places, and a scale factor that is too large by (f_L/f_0)^2/2 (1 - 4 t_e/T).
TEST(TwinAgreement, LockInIsTheRandomWalkAndTheScaleErrorOfTheFormulas) {
    constexpr double lock_hz = 300.0;
    constexpr double rate_arcsec_s = 5000.0;
    constexpr int n_block = 400;  // two seconds
    constexpr int n_blocks = 500;
    TwinConfig config = fine(as_laser(quiet_gyro(), lock_hz));
    config.gyro.light_samples = 1;
    Twin twin{config, Motion::sines(rate_arcsec_s, {{2000.0, 0.37, 0.0}, {700.0, 1.13, 0.0}})};
    double square = 0.0;
    double error = 0.0;
    TwinHalf before = advance(twin, frame(true, 1), 2).back();
    for (int block = 0; block < n_blocks; ++block) {
        double turned = 0.0;
        const TwinHalf start = before;
        for (int h = 0; h < 2 * n_block; ++h) {
            before = twin.advance(frame(true, 1));
            turned += before.truth.dtheta_arcsec;
        }
        const double off = config.gyro.scale_arcsec * static_cast<double>(count_between(start, before)) - turned;
        square += off * off / n_blocks;
        error += off;
    }
    constexpr double bias_hz = 60430.0;
    const double slip_rad = 2.0 * std::numbers::pi * lock_hz * std::sqrt(config.gyro.bias_edge_s / (2.0 * bias_hz));
    const double walk = 3.263 / (2.0 * std::numbers::pi) * slip_rad / std::sqrt(config.gyro.tick_s);
    EXPECT_NEAR(walk / 60.0, 0.0047, 0.0001);  // deg/sqrt(h)
    const double block_s = n_block * config.gyro.tick_s;
    const double step_variance = config.gyro.scale_arcsec * config.gyro.scale_arcsec / 6.0;
    const double mean = error / n_blocks;
    EXPECT_NEAR(std::sqrt((square - mean * mean - step_variance) / block_s), walk, 0.1 * walk);
    const double scale_error =
        0.5 * std::pow(lock_hz / bias_hz, 2) * (1.0 - 4.0 * config.gyro.bias_edge_s / config.gyro.tick_s);
    const double sigma = walk * std::sqrt(n_blocks * block_s);
    EXPECT_NEAR(error, scale_error * rate_arcsec_s * n_blocks * block_s, 3.0 * sigma);
}

// Without shifted reversals a slow rotation is held: half-width K/(2 pi T) 2 d |cos pi (F - 1/4)|, F = f0 (T - t_e)/2.
double dead_zone_arcsec_s(const TwinConfig& config) {
    const double bias_hz = averaged_laser(FourWave{config.laser}, config.laser.bias_field_g).bias_hz;
    const double slip_rad =
        2.0 * std::numbers::pi * config.laser.lock_in_left_hz * std::sqrt(config.gyro.bias_edge_s / (2.0 * bias_hz));
    const double cycles = 0.5 * bias_hz * (config.gyro.tick_s - config.gyro.bias_edge_s);
    return config.gyro.scale_arcsec / (std::numbers::pi * config.gyro.tick_s) * slip_rad *
           std::abs(std::cos(std::numbers::pi * (cycles - 0.25)));
}

double read_arcsec_s(const TwinConfig& config, double rate_arcsec_s, int n_halves) {
    Twin twin{config, Motion::sines(rate_arcsec_s, {})};
    const TwinHalf before = advance(twin, frame(true, 1), 4000).back();
    TwinHalf after = before;
    for (int h = 0; h < n_halves; ++h) after = twin.advance(frame(true, 1));
    return config.gyro.scale_arcsec * static_cast<double>(count_between(before, after)) /
           (0.5 * n_halves * config.gyro.tick_s);
}

TEST(TwinAgreement, ASlowRotationIsHeldInTheDeadZone) {
    for (const double field_g : {14.95, 15.0, 15.06}) {
        TwinConfig config = as_laser(quiet_gyro(), 300.0);
        config.gyro.light_samples = 1;
        config.laser.bias_field_g = field_g;
        const double half_width = dead_zone_arcsec_s(config);
        ASSERT_GT(half_width, 3.0);
        EXPECT_NEAR(read_arcsec_s(config, 0.9 * half_width, 30000), 0.0, 0.05) << field_g;
        EXPECT_GT(read_arcsec_s(config, 1.1 * half_width, 30000), 0.1 * half_width) << field_g;
        EXPECT_NEAR(read_arcsec_s(config, 4.0 * half_width, 30000), half_width * std::sqrt(15.0),
                    0.02 * 4.0 * half_width)
            << field_g;
    }
}

}  // namespace zlg::twin::twin_agreement_test
