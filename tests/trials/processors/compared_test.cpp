#include <zlg/trials/compared.hpp>

#include <zlg/config/config.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace zlg::compared_test {

// This program's core, with one bit wrong in one half, if asked for.
class OtherProcessor final : public rig::Processor {
public:
    explicit OtherProcessor(std::int64_t wrong_half = -1) : wrong_half_{wrong_half} {}

    core::ActuatorFrame start(const rig::ProcessorSettings& s) override {
        return gyro_.start({s.control, s.compensation});
    }
    rig::ProcessorHalf half(const core::SensorFrame& frame) override {
        const firmware::HalfOutput out = gyro_.half(frame);
        rig::ProcessorHalf answer{out.control, out.compensation};
        if (half_++ == wrong_half_) answer.control.health ^= 1u << 20;
        return answer;
    }
    core::DrainOutput drain() override { return gyro_.drain(); }

private:
    firmware::Gyro gyro_;
    std::int64_t wrong_half_;
    std::int64_t half_ = 0;
};

void run(rig::Processor& processor, int halves) {
    config::Config c;
    c.switching.interval_s = 1.0;
    rig::ClosedLoop loop{c, rig::motion(c), &processor};
    for (int k = 0; k < halves; ++k) (void)loop.advance();
    for (auto rest = processor.drain(); rest.has_row || rest.has_gap;) rest = processor.drain();
}

TEST(ComparedProcessor, finds_equal_what_is_equal) {
    OtherProcessor other;
    trials::ComparedProcessor both{other};
    run(both, 800);
    EXPECT_EQ(both.halves(), 800);
    EXPECT_EQ(both.differing(), 0);
    EXPECT_EQ(both.first_difference(), "");
}

TEST(ComparedProcessor, names_the_half_and_the_number_of_one_wrong_bit) {
    OtherProcessor other{123};
    trials::ComparedProcessor both{other};
    run(both, 400);
    EXPECT_EQ(both.differing(), 1);
    EXPECT_EQ(both.first_difference(), "half 123: control.health");
}

TEST(ComparedProcessor, answers_what_the_other_answers) {
    OtherProcessor other{0};
    OtherProcessor same{0};
    trials::ComparedProcessor both{other};
    const core::ActuatorFrame first = both.start({});
    EXPECT_EQ(first, same.start({}));
    EXPECT_EQ(both.half({}).control.health, same.half({}).control.health);
}

// A closed loop with the core outside is the closed loop with the core inside.
TEST(ComparedProcessor, in_a_loop_makes_the_records_of_the_loop_without) {
    config::Config c;
    c.switching.interval_s = 1.0;
    c.switching.schedule = config::Schedule::measured;
    c.switching.interval_min_s = 0.5;
    OtherProcessor other;
    rig::ClosedLoop outside{c, rig::motion(c), &other};
    rig::ClosedLoop here{c, rig::motion(c)};
    for (int k = 0; k < 4000; ++k) {
        const rig::LoopHalf a = outside.advance();
        const rig::LoopHalf b = here.advance();
        ASSERT_EQ(a.record, b.record) << k;
        ASSERT_EQ(a.control.health, b.control.health) << k;
        ASSERT_EQ(a.half_wave_v, b.half_wave_v) << k;
        ASSERT_EQ(a.half_wave_sigma_v, b.half_wave_sigma_v) << k;
        ASSERT_TRUE(a.compensation.has_value());
        ASSERT_FALSE(b.compensation.has_value());
    }
}

}  // namespace zlg::compared_test
