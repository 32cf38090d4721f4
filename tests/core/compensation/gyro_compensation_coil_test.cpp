#include <zlg/core/gyro_compensation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "compensation_support.hpp"
#include "gyro_compensation_support.hpp"

namespace gyro_compensation_coil_test {

using namespace zlg::core;
using namespace compensation_test;
using namespace gyro_compensation_support;

constexpr std::int64_t bias_counts = 150;  // 60 kHz over half a tick
constexpr int n_before = 400;              // ticks with an even current
constexpr int n_ticks = 800;

// At rest. From n_before on the current is 2 % more in positive halves and as much less in negative ones: 3 counts of the bias.
Halves uneven_log(int mode, int first_sign, bool reads) {
    Random random{1};
    Halves halves;
    for (int k = 0; k < 2 * n_ticks; ++k) {
        const int sign = k % 2 == 0 ? first_sign : -first_sign;
        const int uneven = k < 2 * n_before ? 0 : 3;
        HalfRecord half{.half = k, .counts = mode * (sign * bias_counts + uneven)};
        const double current_a = sign + uneven / 150.0 + 0.001 * random.normal();
        half.coil_ua = reads ? static_cast<std::int32_t>(std::lround(1e6 * current_a)) : 0;
        half.bias_sign = static_cast<std::int8_t>(sign);
        half.mode = static_cast<std::int8_t>(mode);
        half.temperature_c = 20.0;
        halves.push_back(half);
    }
    return halves;
}

TEST(GyroCompensation, AnUnevenCurrentIsNoRotation) {
    GyroCompensationConfig config;
    config.relock.method = RelockMethod::none;
    for (const int mode : {1, -1})
        for (const int first_sign : {1, -1}) {
            const Delivered got = run(config, uneven_log(mode, first_sign, true));
            const double sigma = got.rows[0].sigma_arcsec;
            for (unsigned j = 0; j < n_before; ++j) {
                ASSERT_EQ(got.rows[j].dtheta_final_arcsec, 0.0);
                ASSERT_EQ(got.rows[j].sigma_arcsec, sigma);
            }
            // 19.6 arcsec a tick. Two ticks could be a wrong reading; the control calls so large a change not valid.
            for (unsigned j = n_before; j < n_before + 2; ++j)
                ASSERT_NEAR(std::abs(got.rows[j].dtheta_final_arcsec), 6 * 3.263, 1e-9) << j;
            for (unsigned j = n_before + 2; j < n_ticks; ++j) {
                ASSERT_LT(std::abs(got.rows[j].dtheta_final_arcsec), 5.0 * got.rows[j].sigma_arcsec) << j;
                ASSERT_GT(got.rows[j].sigma_arcsec, sigma);
            }
            EXPECT_NEAR(got.rows[n_ticks - 1].dtheta_final_arcsec, 0.0, 0.2);
        }
}

TEST(GyroCompensation, AnUnevenCurrentThatIsNotReadIsARotation) {
    const GyroCompensationConfig config;
    const Delivered got = run(config, uneven_log(1, 1, false));
    EXPECT_NEAR(got.rows[n_ticks - 1].dtheta_final_arcsec, 6 * 3.263, 1e-12);
}

}  // namespace gyro_compensation_coil_test
