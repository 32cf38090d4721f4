#include <zlg/rig/asked_compensation.hpp>

#include <zlg/config/schema.hpp>

#include "test.hpp"

namespace zlg::asked_compensation_test {

using core::RelockMethod;

config::Config of(RelockMethod method) {
    config::Config c;
    c.compensation.relock = method;
    return c;
}

TEST(AskedCompensation, of_a_gyro_that_runs_is_by_mean_squares_unless_another_is_asked_for) {
    EXPECT_EQ(rig::asked_relock({}), RelockMethod::mean_square);
    EXPECT_EQ(rig::asked_compensation({}).relock.method, RelockMethod::mean_square);
    for (const auto method : {RelockMethod::none, RelockMethod::frequency, RelockMethod::joint}) {
        EXPECT_EQ(rig::asked_relock(of(method)), method);
        EXPECT_EQ(rig::asked_compensation(of(method)).relock.method, method);
    }
    config::Config linear;
    linear.compensation.bridge = core::BridgeMethod::linear;
    EXPECT_EQ(rig::asked_compensation(linear).bridge.method, core::BridgeMethod::linear);
}

TEST(AskedCompensation, an_angle_log_names_what_its_angles_rest_on) {
    config::Config c;
    c.gyro.discriminator_per_lambda = 1.0;
    c.perimeter.discriminator_detuning_lambda = {0.1, 0.2, 0.3};
    c.perimeter.discriminator_signal = {0.2, 0.4, 0.5};
    c.drift.random_walk_arcsec_sqrt_s = 0.3;
    c.drift.magnetic_arcsec_s = 5.0;
    c.run.seed = 7;
    const auto value_of = [&](const std::string& key) {
        const config::Settings settings = rig::angle_settings(c);
        const auto found = std::ranges::find(settings, key, &config::Settings::value_type::first);
        return found == settings.end() ? "absent" : found->second;
    };
    EXPECT_EQ(value_of("compensation.relock"), "\"mean_square\"");
    EXPECT_EQ(value_of("drift.random_walk_arcsec_sqrt_s"), "0.3");
    EXPECT_EQ(value_of("gyro.discriminator_per_lambda"), "1");
    EXPECT_NE(value_of("perimeter.discriminator_signal"), "absent");
    EXPECT_EQ(value_of("drift.magnetic_arcsec_s"), "absent");
    EXPECT_EQ(value_of("run.seed"), "absent");
    c.compensation.relock = RelockMethod::none;
    EXPECT_EQ(value_of("compensation.relock"), "\"none\"");
}

}  // namespace zlg::asked_compensation_test
