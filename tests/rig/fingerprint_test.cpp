// The fingerprint of a run: what enters it and what does not.
#include <zlg/rig/fingerprint.hpp>

#include "test.hpp"

namespace zlg::rig::fingerprint_test {

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

// Every number differs from its neighbours and from its default, and whole ones fill what holds them.
Taken made() {
    Taken t;
    t.sensor = {.sequence = 0x89ab'cdefu,
                .timer_ticks = 0x1234'5678'9abc'def0u,
                .counter = 0xffff'ffff'ffff'ff00u,
                .bias_sign = -1,
                .polarity = 1};
    t.sensor.n_light = 2;
    t.sensor.has_light_b = true;
    t.sensor.light_a[0] = 0.5f, t.sensor.light_a[1] = 0.75f;
    t.sensor.light_b[0] = 1.25f, t.sensor.light_b[1] = 1.5f;
    t.sensor.piezo_v = 100.5, t.sensor.coil_current_a = -0.25, t.sensor.temperature_c = 21.5;
    t.sensor.status = 0x89ab'cde0u;
    t.sensor.has_fringe = true;
    t.sensor.fringe_quarter = 3;
    t.sensor.fringe_c = 2.5f, t.sensor.fringe_s = -3.5f;
    core::ActuatorFrame& actuator = t.half.control.actuator;
    actuator = {
        .loop_closed = true, .polarity = -1, .n_set_points = 2, .set_point_v = {}, .edge_offset_ticks = -0x1234'5678};
    actuator.set_point_v[0] = 101.5, actuator.set_point_v[1] = 102.5;
    t.half.record = {.half = 0x0fed'cba9'8765'4321,
                     .counts = -0x0012'3456'789a'bcde,
                     .detuning_lambda = 0.125,
                     .detuning_sq_lambda2 = 0.0625};
    t.half.record.piezo_v = 103.5, t.half.record.temperature_c = 22.5;
    t.half.record.bias_sign = -1, t.half.record.mode = 1;
    t.half.record.edge_offset_ticks = 0x1234'5678, t.half.record.span = 0x2345'6789;
    t.half.record.fringe = 1234.0f, t.half.record.lit = true;
    t.half.truth = {.dtheta_arcsec = 4.5, .false_relock_arcsec = 5.5, .detuning_end_lambda = 6.5, .perimeter_v = 7.5};
    t.half.truth.rounding_arcsec = 8.5, t.half.truth.random_walk_arcsec = 9.5, t.half.truth.lit = true;
    t.row = {.tick = 0x0123'4567'89ab'cdf1,
             .dtheta_arcsec = 1.5,
             .dtheta_final_arcsec = 2.25,
             .sigma_arcsec = 0.375,
             .mode = -1};
    t.row.flags = 0x9abc'def1u;
    return t;
}

// Computed by Python's struct and xxhash, with Q for a whole number modulo 2^64, f and d for the real ones:
//
//   half = pack("<7Q2fQ2f", 0x89abcdef, 0x123456789abcdef0, 2**64 - 256, 2**64 - 1, 1, 1, 2, .5, .75, 1, 1.25, 1.5)
//        + pack("<3d3Q2f", 100.5, -.25, 21.5, 0x89abcde0, 1, 3, 2.5, -3.5)
//        + pack("<3Q2dQ", 1, 2**64 - 1, 2, 101.5, 102.5, 2**64 - 0x12345678)
//        + pack("<2Q4d6Q", 0x0fedcba987654321, 2**64 - 0x123456789abcde, .125, .0625, 103.5, 22.5, 2**64 - 1, 1, 1, 1,
//               0x12345678, 0x23456789)
//        + pack("<f2Q", 1234, 1, 0)
//        + pack("<6dQ", 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 1)
//   row  = pack("<Q3d2Q", 0x0123456789abcdf1, 1.5, 2.25, .375, 2**64 - 1, 0x9abcdef1)
//   xxh64(pack("<2Q", xxh64(half, seed=xxh64(half)), xxh64(row, seed=xxh64(row))))
TEST(Fingerprint, is_the_hash_of_the_listed_bytes) {
    const Taken t = made();
    Fingerprint fingerprint;
    EXPECT_EQ(fingerprint.text(), "af09f71516247c32");
    fingerprint.take(t.half, t.sensor);
    fingerprint.take(t.row);
    EXPECT_EQ(fingerprint.text(), "a66e51c9bbb7270f");
    fingerprint.take(t.half, t.sensor);
    fingerprint.take(t.row);
    EXPECT_EQ(fingerprint.text(), "3b3a8a855d88a14e");
    EXPECT_EQ(fingerprint.value(), 0x3b3a8a855d88a14eu);
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

}  // namespace zlg::rig::fingerprint_test
