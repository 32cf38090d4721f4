#include <zlg/calibration/calibration.hpp>
#include <zlg/calibration/lab_reader.hpp>

#include <zlg/config/schema.hpp>

#include "synthetic_gyro.hpp"

using namespace zlg;
using namespace zlg::calibration;
using namespace synthetic;

namespace {

std::map<std::string, numeric::Estimate> by_key(const Calibration& c) {
    std::map<std::string, numeric::Estimate> found;
    for (const Constant& k : c.constants) found[k.key] = k.estimate;
    return found;
}

}  // namespace

TEST(Calibration, finds_all_constants_of_one_log) {
    const SyntheticGyro gyro{.bias_per_c = 5e-4,
                             .rise_c = 8.0,
                             .detuning_scale = 1.1,
                             .half_wave_per_c = 1e-3,
                             .magnetic_arcsec_s = 4.0,
                             .thermal_arcsec_s = 9.0,
                             .thermal_s = 40.0,
                             .walk_arcsec_sqrt_s = 1.5};
    const auto logs = one_log(gyro, 250.0);
    auto found = by_key(calibrate(logs, {}));
    const std::map<std::string, double> truth{{"gyro.bias_hz", gyro.bias_hz},
                                              {"gyro.bias_temperature_coefficient_per_c", 5e-4},
                                              {"gyro.bias_chi", 4.0 / 1.21},
                                              {"piezo.half_wave_v", 40.0},
                                              {"piezo.half_wave_temperature_coefficient_per_c", 1e-3},
                                              {"drift.magnetic_arcsec_s", 4.0},
                                              {"drift.magnetic_thermal_arcsec_s", 9.0},
                                              {"drift.thermal_time_s", 40.0},
                                              {"drift.nonmagnetic_arcsec_s", 5.0},
                                              {"drift.random_walk_arcsec_sqrt_s", 1.5}};
    EXPECT_EQ(found.size(), truth.size() + 2);
    for (const char* of_field : {"field.sensitivity_arcsec_s_g", "field.sensitivity_per_c"})
        EXPECT_EQ(found[of_field].reason, "the field of a log is not known");
    for (const auto& [key, value] : truth) {
        ASSERT_TRUE(found[key].determined) << key << ": " << found[key].reason;
        EXPECT_LT(std::abs(errors_off(found[key], value)), 4.5) << key;
    }
}

TEST(Calibration, every_key_is_one_of_the_configuration) {
    const auto logs = one_log(SyntheticGyro{}, 20.0);
    for (const Constant& c : calibrate(logs, {}).constants) {
        bool known = false;
        for (const auto& info : zlg::config::describe_keys())
            known = known || (info.section + "." + info.name == c.key && info.unit == c.unit);
        EXPECT_TRUE(known) << c.key << " in " << c.unit;
    }
}

TEST(Calibration, an_empty_log_determines_nothing_and_says_why) {
    LabReader reader{"short", 0.005};
    reader.take({});
    reader.take({.half = 1, .bias_sign = -1});
    const std::vector<LabLog> logs{reader.finish()};
    for (const Constant& c : calibrate(logs, {}).constants) {
        EXPECT_FALSE(c.estimate.determined) << c.key;
        EXPECT_FALSE(c.estimate.reason.empty()) << c.key;
    }
}

TEST(Calibration, refuses_logs_of_different_ticks_and_none) {
    std::vector<LabLog> logs = one_log(SyntheticGyro{}, 5.0);
    logs.push_back(logs.front());
    logs.back().tick_s = 0.004;
    EXPECT_THROW((void)calibrate(logs, {}), std::invalid_argument);
    EXPECT_THROW((void)calibrate({}, {}), std::invalid_argument);
}
