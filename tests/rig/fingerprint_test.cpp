// The fingerprint of a run: what enters it and what does not.
#include <zlg/rig/fingerprint.hpp>

#include "test.hpp"

namespace zlg::rig {
namespace {

struct Taken {
    LoopHalf half;
    core::SensorFrame sensor;
    core::AngleRow row;
};

std::string fingerprint_of(const Taken& taken) {
    Fingerprint fingerprint;
    fingerprint.take(taken.half, taken.sensor);
    fingerprint.take(taken.row);
    return fingerprint.text();
}

// Every number differs from its neighbours and from its default.
Taken made() {
    Taken t;
    t.sensor = {.sequence = 11, .timer_ticks = 22, .counter = 0xffff'ffff'ffff'ff00u, .bias_sign = -1, .polarity = 1};
    t.sensor.n_light = 2;
    t.sensor.has_light_b = true;
    t.sensor.light_a[0] = 0.5f, t.sensor.light_a[1] = 0.75f;
    t.sensor.light_b[0] = 1.25f, t.sensor.light_b[1] = 1.5f;
    t.sensor.piezo_v = 100.5, t.sensor.coil_current_a = -0.25, t.sensor.temperature_c = 21.5;
    t.sensor.status = 0;
    t.sensor.has_fringe = true;
    t.sensor.fringe_quarter = 3;
    t.sensor.fringe_c = 2.5f, t.sensor.fringe_s = -3.5f;
    core::ActuatorFrame& actuator = t.half.control.actuator;
    actuator = {.loop_closed = true, .polarity = -1, .n_set_points = 2, .set_point_v = {}, .edge_offset_ticks = -7};
    actuator.set_point_v[0] = 101.5, actuator.set_point_v[1] = 102.5;
    t.half.record = {.half = 33, .counts = -150, .detuning_lambda = 0.125, .detuning_sq_lambda2 = 0.0625};
    t.half.record.piezo_v = 103.5, t.half.record.temperature_c = 22.5;
    t.half.record.bias_sign = -1, t.half.record.mode = 1;
    t.half.record.edge_offset_ticks = 5, t.half.record.span = 2;
    t.half.record.fringe = 1234.0f, t.half.record.lit = true;
    t.half.truth = {.dtheta_arcsec = 4.5, .false_relock_arcsec = 5.5, .detuning_end_lambda = 6.5, .perimeter_v = 7.5};
    t.half.truth.rounding_arcsec = 8.5, t.half.truth.random_walk_arcsec = 9.5, t.half.truth.lit = true;
    t.row = {.tick = 16, .dtheta_arcsec = 1.5, .dtheta_final_arcsec = 2.25, .sigma_arcsec = 0.375, .mode = -1};
    t.row.flags = 5;
    return t;
}

// Computed by Python's struct and xxhash, with Q for a whole number modulo 2^64, f and d for the real ones:
//
//   half = pack("<7Q2fQ2f", 11, 22, 2**64 - 256, 2**64 - 1, 1, 1, 2, .5, .75, 1, 1.25, 1.5)
//        + pack("<3d3Q2f", 100.5, -.25, 21.5, 0, 1, 3, 2.5, -3.5)
//        + pack("<3Q2dQ", 1, 2**64 - 1, 2, 101.5, 102.5, 2**64 - 7)
//        + pack("<2Q4d6Q", 33, 2**64 - 150, .125, .0625, 103.5, 22.5, 2**64 - 1, 1, 1, 1, 5, 2)
//        + pack("<f2Q", 1234, 1, 0)
//        + pack("<6dQ", 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 1)
//   row  = pack("<Q3d2Q", 16, 1.5, 2.25, .375, 2**64 - 1, 5)
//   xxh64(pack("<2Q", xxh64(half, seed=xxh64(half)), xxh64(row, seed=xxh64(row))))
TEST(Fingerprint, is_the_hash_of_the_listed_bytes) {
    const Taken t = made();
    Fingerprint fingerprint;
    EXPECT_EQ(fingerprint.text(), "af09f71516247c32");
    fingerprint.take(t.half, t.sensor);
    fingerprint.take(t.row);
    EXPECT_EQ(fingerprint.text(), "104037b64658366d");
    fingerprint.take(t.half, t.sensor);
    fingerprint.take(t.row);
    EXPECT_EQ(fingerprint.text(), "69c5e5ec2bbb8885");
    EXPECT_EQ(fingerprint.value(), 0x69c5e5ec2bbb8885u);
}

TEST(Fingerprint, equal_runs_have_equal_ones) { EXPECT_EQ(fingerprint_of(made()), fingerprint_of(made())); }

// Changes each bit of a number in turn and notes the fingerprint of each change: all of them must differ.
class Changes {
public:
    explicit Changes(Taken taken) : taken_{taken}, seen_{fingerprint_of(taken)} {}

    template <class Number, class Member>
    void each_bit_of(Number Taken::*record, Member Number::*member) {
        each_bit([=](Taken& t) -> Member& { return t.*record.*member; });
    }

    template <class Access>
    void each_bit(Access access) {
        using Value = std::remove_reference_t<decltype(access(taken_))>;
        const Value before = access(taken_);
        for (std::size_t bit = 0; bit < (std::is_same_v<Value, bool> ? 1 : 8 * sizeof(Value)); ++bit) {
            access(taken_) = flipped(before, bit);
            note();
        }
        access(taken_) = before;
    }

    template <class Access, class Value>
    void other(Access access, Value value) {
        const auto before = access(taken_);
        access(taken_) = value;
        note();
        access(taken_) = before;
    }

    [[nodiscard]] bool all_differ() const { return seen_.size() == n_changes_ + 1; }
    [[nodiscard]] std::size_t number() const { return n_changes_; }

private:
    void note() {
        seen_.insert(fingerprint_of(taken_));
        ++n_changes_;
    }

    template <class Value>
    static Value flipped(Value value, std::size_t bit) {
        if constexpr (std::is_same_v<Value, bool>) {
            return !value;
        } else {
            using Word = std::conditional_t<sizeof(Value) == 8, std::uint64_t,
                                            std::conditional_t<sizeof(Value) == 4, std::uint32_t, std::uint8_t>>;
            return std::bit_cast<Value>(static_cast<Word>(std::bit_cast<Word>(value) ^ (Word{1} << bit)));
        }
    }

    Taken taken_;
    std::set<std::string> seen_;
    std::size_t n_changes_ = 0;
};

TEST(Fingerprint, every_bit_of_a_sensor_frame_changes_it) {
    using core::SensorFrame;
    Changes changes{made()};
    const auto each = [&](auto... member) { (changes.each_bit_of(&Taken::sensor, member), ...); };
    each(&SensorFrame::sequence, &SensorFrame::timer_ticks, &SensorFrame::counter, &SensorFrame::bias_sign,
         &SensorFrame::polarity, &SensorFrame::loop_closed, &SensorFrame::has_light_b, &SensorFrame::piezo_v,
         &SensorFrame::coil_current_a, &SensorFrame::temperature_c, &SensorFrame::status, &SensorFrame::has_fringe,
         &SensorFrame::fringe_quarter, &SensorFrame::fringe_c, &SensorFrame::fringe_s);
    for (std::size_t k = 0; k < 2; ++k) {
        changes.each_bit([k](Taken& t) -> float& { return t.sensor.light_a[k]; });
        changes.each_bit([k](Taken& t) -> float& { return t.sensor.light_b[k]; });
    }
    for (const int n : {0, 1, 3, 64})
        changes.other([](Taken& t) -> std::uint8_t& { return t.sensor.n_light; }, static_cast<std::uint8_t>(n));
    EXPECT_TRUE(changes.all_differ()) << changes.number() << " changes";
}

TEST(Fingerprint, every_bit_of_an_actuator_frame_changes_it) {
    Changes changes{made()};
    changes.each_bit([](Taken& t) -> bool& { return t.half.control.actuator.loop_closed; });
    changes.each_bit([](Taken& t) -> std::int8_t& { return t.half.control.actuator.polarity; });
    changes.each_bit([](Taken& t) -> std::int32_t& { return t.half.control.actuator.edge_offset_ticks; });
    for (std::size_t k = 0; k < 2; ++k)
        changes.each_bit([k](Taken& t) -> double& { return t.half.control.actuator.set_point_v[k]; });
    for (const int n : {1, 3, 16})
        changes.other([](Taken& t) -> std::uint8_t& { return t.half.control.actuator.n_set_points; },
                      static_cast<std::uint8_t>(n));
    EXPECT_TRUE(changes.all_differ()) << changes.number() << " changes";
}

TEST(Fingerprint, every_bit_of_a_half_record_changes_it) {
    using core::HalfRecord;
    Changes changes{made()};
    const auto each = [&](auto... member) {
        (changes.each_bit([member](Taken & t) -> auto& { return t.half.record.*member; }), ...);
    };
    each(&HalfRecord::half, &HalfRecord::counts, &HalfRecord::detuning_lambda, &HalfRecord::detuning_sq_lambda2,
         &HalfRecord::piezo_v, &HalfRecord::temperature_c, &HalfRecord::bias_sign, &HalfRecord::mode,
         &HalfRecord::loop_closed, &HalfRecord::valid, &HalfRecord::edge_offset_ticks, &HalfRecord::span,
         &HalfRecord::fringe, &HalfRecord::lit);
    EXPECT_TRUE(changes.all_differ()) << changes.number() << " changes";
}

TEST(Fingerprint, every_bit_of_the_truth_changes_it) {
    using twin::TwinTruth;
    Changes changes{made()};
    const auto each = [&](auto... member) {
        (changes.each_bit([member](Taken & t) -> auto& { return t.half.truth.*member; }), ...);
    };
    each(&TwinTruth::dtheta_arcsec, &TwinTruth::false_relock_arcsec, &TwinTruth::detuning_end_lambda,
         &TwinTruth::perimeter_v, &TwinTruth::rounding_arcsec, &TwinTruth::random_walk_arcsec, &TwinTruth::lit);
    EXPECT_TRUE(changes.all_differ()) << changes.number() << " changes";
}

TEST(Fingerprint, every_bit_of_a_logged_angle_changes_it) {
    using core::AngleRow;
    Changes changes{made()};
    const auto each = [&](auto... member) { (changes.each_bit_of(&Taken::row, member), ...); };
    each(&AngleRow::tick, &AngleRow::dtheta_arcsec, &AngleRow::dtheta_final_arcsec, &AngleRow::sigma_arcsec,
         &AngleRow::mode, &AngleRow::flags);
    EXPECT_TRUE(changes.all_differ()) << changes.number() << " changes";
}

TEST(Fingerprint, samples_that_a_frame_does_not_hold_do_not_matter) {
    Taken other = made();
    other.sensor.light_a[2] = 1.0f;
    other.sensor.light_b[2] = 1.0f;
    other.half.control.actuator.set_point_v[2] = 1.0;
    other.row.relock_arcsec = 1.0;
    EXPECT_EQ(fingerprint_of(other), fingerprint_of(made()));
    Taken one_beam = made();
    one_beam.sensor.has_light_b = false;
    const std::string without = fingerprint_of(one_beam);
    one_beam.sensor.light_b[0] = 9.0f;
    EXPECT_EQ(fingerprint_of(one_beam), without);
}

TEST(Fingerprint, all_patterns_of_nan_are_one) {
    const auto with = [](std::uint64_t real, std::uint32_t fringe) {
        Taken t = made();
        t.half.record.detuning_lambda = std::bit_cast<double>(real);
        t.half.record.fringe = std::bit_cast<float>(fringe);
        return fingerprint_of(t);
    };
    const std::string quiet = with(0x7ff8'0000'0000'0000u, 0x7fc0'0000u);
    EXPECT_EQ(with(0xfff8'0000'0000'0000u, 0xffc0'0000u), quiet);
    EXPECT_EQ(with(0x7ff8'0000'0000'1234u, 0x7fc0'1234u), quiet);
    EXPECT_EQ(with(0x7ff0'0000'0000'0001u, 0x7f80'0001u), quiet);
    EXPECT_NE(with(0x7ff0'0000'0000'0000u, 0x7fc0'0000u), quiet);  // infinity
    EXPECT_NE(with(0x7ff8'0000'0000'0000u, 0x7f80'0000u), quiet);
}

TEST(Fingerprint, the_sign_of_zero_matters) {
    Taken zero = made(), minus_zero = made();
    zero.row.dtheta_arcsec = 0.0;
    minus_zero.row.dtheta_arcsec = -0.0;
    EXPECT_NE(fingerprint_of(zero), fingerprint_of(minus_zero));
}

TEST(Fingerprint, rows_may_come_before_or_after_their_halves) {
    Taken first = made(), second = made();
    second.half.record.half = 34;
    second.row.tick = 17;
    const auto of = [](auto... steps) {
        Fingerprint fingerprint;
        (steps(fingerprint), ...);
        return fingerprint.text();
    };
    const auto half = [](const Taken& t) { return [&t](Fingerprint& f) { f.take(t.half, t.sensor); }; };
    const auto row = [](const Taken& t) { return [&t](Fingerprint& f) { f.take(t.row); }; };
    const std::string in_turn = of(half(first), row(first), half(second), row(second));
    EXPECT_EQ(of(row(first), row(second), half(first), half(second)), in_turn);
    EXPECT_EQ(of(half(first), half(second), row(first), row(second)), in_turn);
    // Their own order does.
    EXPECT_NE(of(half(second), row(first), half(first), row(second)), in_turn);
    EXPECT_NE(of(half(first), row(second), half(second), row(first)), in_turn);
    EXPECT_NE(of(half(first), row(first), half(second)), in_turn);
    EXPECT_NE(of(half(first), row(first), row(second)), in_turn);
}

}  // namespace
}  // namespace zlg::rig
