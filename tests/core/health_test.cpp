#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <set>
#include <string>
#include <zlg/core/health.hpp>

namespace zlg::core {
namespace {

constexpr HealthConfig config{.counts_limit = 1000};
static_assert(check(config) == HealthFault::none);
static_assert(check(HealthConfig{.counts_limit = 0}) == HealthFault::counts_limit);

TEST(Health, AGoodHalfHasNoBit) { EXPECT_EQ(health_bits(config, {}), 0u); }

TEST(Health, EveryReportSetsItsOwnBitAndNoOther) {
    const auto bit = [](bool HealthReport::*member) {
        HealthReport r;
        r.*member = true;
        return health_bits(config, r);
    };
    EXPECT_EQ(bit(&HealthReport::frame_missed), health_frame_missed);
    EXPECT_EQ(bit(&HealthReport::sequence_error), health_sequence_error);
    EXPECT_EQ(bit(&HealthReport::sign_error), health_sign_error);
    EXPECT_EQ(bit(&HealthReport::timer_error), health_timer_error);
    EXPECT_EQ(bit(&HealthReport::echo_error), health_echo_error);
    EXPECT_EQ(bit(&HealthReport::light_lost), health_light_lost);
    EXPECT_EQ(bit(&HealthReport::light_unusable), health_light_unusable);
    EXPECT_EQ(bit(&HealthReport::detuning_over_limit), health_detuning_over_limit);
    EXPECT_EQ(bit(&HealthReport::piezo_near_range_end), health_piezo_near_range_end);
    EXPECT_EQ(bit(&HealthReport::piezo_not_finite), health_piezo_not_finite);
    EXPECT_EQ(bit(&HealthReport::temperature_not_finite), health_temperature_not_finite);
    EXPECT_EQ(bit(&HealthReport::switching), health_switching);
    EXPECT_EQ(bit(&HealthReport::relock_failed), health_relock_failed);
    EXPECT_EQ(bit(&HealthReport::searching), health_searching);
    EXPECT_EQ(bit(&HealthReport::half_wave_rejected), health_half_wave_rejected);
}

TEST(Health, AJumpIsMoreCountsThanTheLimitInEitherDirection) {
    const auto bits = [](std::int64_t counts) { return health_bits(config, {.counts = counts}); };
    EXPECT_EQ(bits(1000), 0u);
    EXPECT_EQ(bits(-1000), 0u);
    EXPECT_EQ(bits(1001), health_counter_jump);
    EXPECT_EQ(bits(-1001), health_counter_jump);
    EXPECT_EQ(bits(std::numeric_limits<std::int64_t>::min()), health_counter_jump);
    EXPECT_EQ(bits(std::numeric_limits<std::int64_t>::max()), health_counter_jump);
}

TEST(Health, BitsHaveDistinctNamesInTheirOrder) {
    const std::set<std::string> names(health_bit_names.begin(), health_bit_names.end());
    EXPECT_EQ(names.size(), health_bit_names.size());
    EXPECT_STREQ(health_bit_names[std::countr_zero(std::uint32_t{health_light_lost})], "light_lost");
    EXPECT_STREQ(health_bit_names[std::countr_zero(std::uint32_t{health_counter_jump})], "counter_jump");
    EXPECT_STREQ(health_bit_names.back(), "half_wave_rejected");
    EXPECT_EQ(std::uint32_t{1} << (health_bit_names.size() - 1), health_half_wave_rejected);
}

}  // namespace
}  // namespace zlg::core
