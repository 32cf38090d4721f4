// Calibration against the twin and the core: the constants of a hundred random gyros, within their standard errors.

#include <zlg/calibration/calibration.hpp>
#include <zlg/calibration/lab_reader.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace {

using namespace zlg;

constexpr int n_twins = 100;
constexpr double log_s = 300.0;

struct Specimen {
    config::Config config;
    double rate_arcsec_s;   // known
    double detuning_scale;  // of a log whose discriminator was wrong by so much
};

class Draw {
public:
    explicit Draw(std::uint64_t seed) : random_{seed} {}
    double operator()(double from, double to) {
        return from + (to - from) * std::uniform_real_distribution<double>{}(random_);
    }
    double either(double from, double to) { return (*this)(0.0, 1.0) < 0.5 ? (*this)(from, to) : -(*this)(from, to); }

private:
    std::mt19937_64 random_;
};

// Warming and switching are quick, so that five minutes show what a laboratory sees in hours.
Specimen specimen(int k) {
    Draw draw{1000 + static_cast<std::uint64_t>(k)};
    config::Config c;
    c.run.seed = static_cast<std::uint64_t>(k + 1);
    c.gyro.bias_hz = draw(50e3, 70e3);
    c.gyro.bias_chi = draw(3.0, 8.0);
    c.gyro.bias_temperature_coefficient_per_c = draw(-2e-3, 2e-3);
    c.gyro.temperature_rise_c = draw(10.0, 30.0);
    c.gyro.light_samples = 8;
    c.gyro.light_noise_lambda = draw(0.001, 0.006);
    c.gyro.first_bias_sign = draw(0.0, 1.0) < 0.5 ? -1 : 1;
    c.drift.magnetic_arcsec_s = draw(-20.0, 20.0);
    c.drift.magnetic_thermal_arcsec_s = draw.either(8.0, 20.0);
    c.drift.thermal_time_s = draw(30.0, 90.0);
    c.drift.nonmagnetic_arcsec_s = draw(-20.0, 20.0);
    c.drift.random_walk_arcsec_sqrt_s = draw(1.0, 2.5);
    c.perimeter.loop = static_cast<config::Loop>(k % 3);
    c.perimeter.tau_s = draw(0.006, 0.015);
    c.perimeter.miss_lambda = draw(0.1, 0.22);
    c.piezo.half_wave_v = draw(35.0, 60.0);
    c.piezo.half_wave_temperature_coefficient_per_c = draw(-3e-3, 3e-3);
    c.piezo.half_wave_error = 0.05;
    c.switching.interval_s = draw(1.5, 3.0);
    const double rate = draw(-50.0, 50.0);
    c.motion.kind = config::MotionKind::constant;
    c.motion.rate_arcsec_s = rate;
    return {.config = c, .rate_arcsec_s = rate, .detuning_scale = draw(0.8, 1.25)};
}

calibration::LabLog record(const Specimen& s) {
    rig::ClosedLoop loop{s.config, rig::motion(s.config)};
    calibration::LabReader reader{"twin", s.config.gyro.tick_s};
    const auto halves = std::llround(2.0 * log_s / s.config.gyro.tick_s);
    for (std::int64_t h = 0; h < halves; ++h) {
        core::HalfRecord r = loop.advance().record;
        r.detuning_lambda *= s.detuning_scale;
        r.detuning_sq_lambda2 *= s.detuning_scale * s.detuning_scale;
        reader.take(r);
    }
    return reader.finish();
}

std::map<std::string, double> truth(const Specimen& s) {
    const config::Config& c = s.config;
    return {{"gyro.bias_hz", c.gyro.bias_hz},
            {"gyro.bias_temperature_coefficient_per_c", c.gyro.bias_temperature_coefficient_per_c},
            {"gyro.bias_chi", c.gyro.bias_chi / (s.detuning_scale * s.detuning_scale)},
            {"piezo.half_wave_v", c.piezo.half_wave_v},
            {"piezo.half_wave_temperature_coefficient_per_c", c.piezo.half_wave_temperature_coefficient_per_c},
            {"drift.magnetic_arcsec_s", c.drift.magnetic_arcsec_s},
            {"drift.magnetic_thermal_arcsec_s", c.drift.magnetic_thermal_arcsec_s},
            {"drift.thermal_time_s", c.drift.thermal_time_s},
            {"drift.nonmagnetic_arcsec_s", c.drift.nonmagnetic_arcsec_s},
            {"drift.random_walk_arcsec_sqrt_s", c.drift.random_walk_arcsec_sqrt_s}};
}

// The greatest standard error, relative to the constant, that still is a calibration.
const std::map<std::string, double> usual_sigma{
    {"gyro.bias_hz", 5e-4}, {"gyro.bias_chi", 0.02}, {"piezo.half_wave_v", 1e-3}};

struct Errors {
    std::vector<double> in_sigmas;
    int refused = 0;
};

std::map<std::string, Errors> errors_of_all() {
    std::map<std::string, Errors> errors;
    for (int k = 0; k < n_twins; ++k) {
        const Specimen s = specimen(k);
        const std::vector<calibration::LabLog> logs{record(s)};
        const auto true_value = truth(s);
        const auto found = calibration::calibrate(logs, {.rate_arcsec_s = s.rate_arcsec_s});
        for (const calibration::Constant& c : found.constants) {
            // One rate does not tell the one, an unknown field not the others.
            if (c.key.starts_with("field.")) continue;
            Errors& e = errors[c.key];
            if (!c.estimate.determined) {
                ++e.refused;
                continue;
            }
            const double value = true_value.at(c.key);
            e.in_sigmas.push_back((c.estimate.value - value) / c.estimate.sigma);
            const auto usual = usual_sigma.find(c.key);
            if (usual != usual_sigma.end())
                EXPECT_LT(c.estimate.sigma, usual->second * value) << c.key << ", twin " << k;
        }
    }
    return errors;
}

}  // namespace

// A hundred errors of unit variance: their mean scatters by 0.1, their mean square by 0.14. The room beside three of
// that is for standard errors that are cautious, and for the few errors that are not normal. A sanitizer sees the same
// code in the tests of single gyros.
TEST(CalibrationTwins, recovers_the_constants_of_a_hundred_gyros_within_its_standard_errors) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "four minutes with a sanitizer";
#endif
    const auto errors = errors_of_all();
    EXPECT_EQ(errors.size(), truth(specimen(0)).size());
    for (const auto& [key, e] : errors) {
        const auto n = static_cast<double>(e.in_sigmas.size());
        ASSERT_GE(n, 80.0) << key << " is refused too often";
        double sum = 0.0;
        double sum_sq = 0.0;
        double worst = 0.0;
        for (const double x : e.in_sigmas) {
            sum += x;
            sum_sq += x * x;
            worst = std::max(worst, std::abs(x));
        }
        const double mean = sum / n;
        testing::Test::RecordProperty(key, std::to_string(mean) + " " + std::to_string(sum_sq / n - mean * mean) + " " +
                                               std::to_string(e.refused));
        EXPECT_LT(std::abs(mean), 3.0 / std::sqrt(n)) << key;
        EXPECT_GT(sum_sq / n - mean * mean, 0.5) << key;
        EXPECT_LT(sum_sq / n - mean * mean, 1.5) << key;
        EXPECT_LT(worst, 4.5) << key;
    }
}
