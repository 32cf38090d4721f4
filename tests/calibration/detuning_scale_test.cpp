#include <zlg/calibration/detuning_scale.hpp>

#include "synthetic_gyro.hpp"

using namespace zlg::calibration;
using namespace synthetic;

namespace {

DetuningScale scale_of(const std::vector<LabLog>& logs, bool stepped = false) {
    return find_detuning_scale(logs, find_half_wave_law(logs, 20.0, 0.0), stepped);
}

}  // namespace

TEST(DetuningScale, finds_what_the_log_calls_a_wavelength) {
    for (const double g : {0.8, 1.0, 1.3}) {
        const DetuningScale found = scale_of(one_log({.detuning_scale = g}, 120.0));
        ASSERT_TRUE(found.scale.determined) << found.scale.reason;
        EXPECT_LT(std::abs(errors_off(found.scale, g)), 4.0) << g;
        EXPECT_LT(found.scale.sigma, 0.005 * g);
        EXPECT_EQ(found.n_relocks, 59);
    }
}

TEST(DetuningScale, a_log_without_voltages_or_detuning_has_no_ruler) {
    const auto nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<LabLog> no_v{log_of(SyntheticGyro{}, 60.0, [nan](HalfRecord& r) { r.piezo_v = nan; })};
    EXPECT_NE(scale_of(no_v).scale.reason.find("half-wave"), std::string::npos);
    const std::vector<LabLog> no_dl{log_of(SyntheticGyro{}, 60.0, [nan](HalfRecord& r) { r.detuning_lambda = nan; })};
    EXPECT_NE(scale_of(no_dl).scale.reason.find("detuning_lambda"), std::string::npos);
}

TEST(DetuningScale, a_miss_within_noise_tells_nothing) {
    const DetuningScale found = scale_of(one_log({.miss_lambda = 1e-4}, 60.0));
    EXPECT_FALSE(found.scale.determined);
}

// Between 2.5 ms readings a fall by 1/e^(5/4) has a course that four of them do not show.
TEST(DetuningScale, a_re_lock_that_is_quicker_than_the_readings_is_refused) {
    const DetuningScale found = scale_of(one_log({.tau_s = 0.002}, 60.0));
    EXPECT_FALSE(found.scale.determined);
    EXPECT_NE(found.scale.reason.find("over within"), std::string::npos) << found.scale.reason;
}

TEST(DetuningScale, a_slow_loop_is_waited_for) {
    const DetuningScale found = scale_of(one_log({.tau_s = 0.05, .segment_ticks = 2000}, 400.0));
    ASSERT_TRUE(found.scale.determined) << found.scale.reason;
    EXPECT_LT(std::abs(errors_off(found.scale, 1.0)), 4.0);
}
