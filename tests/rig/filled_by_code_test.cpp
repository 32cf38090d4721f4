// A configuration that code has filled is judged where a gyro is made of it: the range of each key is that of the table
// of keys, and the line names the key.

#include <zlg/config/schema.hpp>
#include <zlg/rig/closed_loop.hpp>

#include "test.hpp"

namespace zlg::filled_by_code_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Member {
    const char* key;
    std::function<void(config::Config&, double)> set;
    std::vector<double> bad;
};

#define ZLG_MEMBER(member, ...)                                                                                       \
    Member {                                                                                                          \
#member, [](config::Config & c, double v) { c.member = static_cast<decltype(c.member)>(v); }, { __VA_ARGS__ } \
    }

// One of each section and of each kind of range: `check` goes through all keys of the table alike.
const std::vector<Member> members = {ZLG_MEMBER(gyro.tick_s, nan, 0.0, -1.0, 11.0),
                                     ZLG_MEMBER(gyro.bias_edge_s, nan, -1e-6, 0.0025),
                                     ZLG_MEMBER(gyro.first_bias_sign, 0.0, 2.0),
                                     ZLG_MEMBER(gyro.reference_temperature_c, nan),
                                     ZLG_MEMBER(gyro.light_samples, 0.0, 65.0),
                                     ZLG_MEMBER(gyro.discriminator_per_lambda, nan, 0.0),
                                     ZLG_MEMBER(drift.random_walk_arcsec_sqrt_s, nan, -1.0, 2e6),
                                     ZLG_MEMBER(perimeter.miss_lambda, nan, -0.1, 0.24),
                                     ZLG_MEMBER(piezo.half_wave_v, nan, 0.0, -40.0),
                                     ZLG_MEMBER(piezo.mirror_hz, nan, 50.0),
                                     ZLG_MEMBER(laser.perimeter_m, nan, infinity, -infinity),
                                     ZLG_MEMBER(laser.upper_isotope_ratio, nan, infinity, 1.5)};

TEST(FilledByCode, ANumberOutOfItsRangeIsRefusedByItsKey) {
    for (const Member& member : members) {
        for (const double bad : member.bad) {
            config::Config c;
            member.set(c, bad);
            const auto make = [&] { (void)rig::ClosedLoop{c, twin::Motion::rest()}; };
            const std::string said = test::refusal_by<config::ConfigError>(make);
            EXPECT_TRUE(said.starts_with(member.key)) << member.key << " = " << bad << ": " << said;
        }
    }
}

TEST(FilledByCode, AFaultOutOfItsRangeIsRefusedByItsKey) {
    config::Config c;
    c.faults = {.kind = {twin::FaultKind::shock}, .at_s = {-1.0}, .duration_s = {0.01}, .size = {0.1}};
    EXPECT_THROW((void)rig::ClosedLoop(c, twin::Motion::rest()), config::ConfigError);
    c.faults.at_s = {1.0};
    c.faults.duration_s = {nan};
    EXPECT_THROW((void)rig::ClosedLoop(c, twin::Motion::rest()), config::ConfigError);
    c.faults.duration_s = {0.01};
    EXPECT_NO_THROW((void)rig::ClosedLoop(c, twin::Motion::rest()));
    c.faults.kind = {static_cast<twin::FaultKind>(99)};
    EXPECT_THROW((void)rig::ClosedLoop(c, twin::Motion::rest()), config::ConfigError);
}

}  // namespace zlg::filled_by_code_test
