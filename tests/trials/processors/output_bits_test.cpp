#include <zlg/trials/output_bits.hpp>

#include "test.hpp"

namespace zlg::trials::output_bits_test {

using firmware::HalfOutput;

TEST(OutputBits, of_a_real_number_are_those_of_ieee_754) {
    EXPECT_EQ(bits_of(1.0), 0x3ff0000000000000u);
    EXPECT_EQ(bits_of(-0.0), 0x8000000000000000u);
    EXPECT_EQ(bits_of(std::int8_t{-1}), 0xffffffffffffffffu);
    EXPECT_EQ(bits_of(true), 1u);
}

TEST(OutputBits, differ_where_values_compare_equal) {
    HalfOutput a;
    HalfOutput b;
    EXPECT_EQ(first_difference(a, b), "");
    a.control.actuator.set_point_v[7] = 0.0;
    b.control.actuator.set_point_v[7] = -0.0;
    EXPECT_EQ(first_difference(a, b), "actuator.set_point_v");
}

TEST(OutputBits, agree_of_a_quantity_that_was_not_measured) {
    HalfOutput a;
    a.control.record.detuning_lambda = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(first_difference(a, HalfOutput{a}), "");
}

// Each member by itself: one that was forgotten would not be seen.
TEST(OutputBits, see_every_member) {
    const HalfOutput plain;
    const auto sees = [&](auto&& change, const char* name) {
        HalfOutput changed;
        change(changed);
        EXPECT_EQ(first_difference(plain, changed), name);
    };
    sees([](HalfOutput& o) { o.control.actuator.edge_offset_ticks = 1; }, "actuator.edge_offset_ticks");
    sees([](HalfOutput& o) { o.control.record.counts = 1; }, "record.counts");
    sees([](HalfOutput& o) { o.control.record.temperature_c = 1.0; }, "record.temperature_c");
    sees([](HalfOutput& o) { o.control.record.span = 2; }, "record.span");
    sees([](HalfOutput& o) { o.control.record.lit = true; }, "record.lit");
    sees([](HalfOutput& o) { o.control.health = 1u << 31; }, "control.health");
    sees([](HalfOutput& o) { o.control.event.half_wave_v = 1e-300; }, "event.half_wave_v");
    sees([](HalfOutput& o) { o.compensation.sample.flags = 1; }, "sample.flags");
    sees([](HalfOutput& o) { o.compensation.sample.final_row.relock_arcsec = 1.0; }, "final_row.relock_arcsec");
    sees([](HalfOutput& o) { o.compensation.sample.gap.sigma_sum_arcsec = 1.0; }, "gap.sigma_sum_arcsec");
    sees([](HalfOutput& o) { o.compensation.angle_arcsec = 1.0; }, "compensation.angle_arcsec");
}

TEST(BitHash, is_fnv_1a_of_the_bytes) {
    // An empty input gives the offset basis; other values depend on every number and its place.
    EXPECT_EQ(BitHash{}.value(), 0xcbf29ce484222325u);
    BitHash a;
    BitHash b;
    core::DrainOutput first;
    core::DrainOutput second;
    second.row.tick = 1;
    a.add(first), a.add(second);
    b.add(second), b.add(first);
    EXPECT_NE(a.value(), b.value());
}

}  // namespace zlg::trials::output_bits_test
