// Faults in general: repeatable, at random, refused; and the same in a laser.
#include <zlg/twin/faults.hpp>

#include "faults_support.hpp"

namespace zlg::twin::faults_test {

bool same_bits(const TwinHalf& a, const TwinHalf& b) {
    return a.sensor.counter == b.sensor.counter && a.sensor.light_a == b.sensor.light_a &&
           a.sensor.light_b == b.sensor.light_b && a.sensor.piezo_v == b.sensor.piezo_v &&
           a.sensor.coil_current_a == b.sensor.coil_current_a && a.sensor.temperature_c == b.sensor.temperature_c &&
           a.sensor.sequence == b.sensor.sequence && a.sensor.timer_ticks == b.sensor.timer_ticks &&
           a.sensor.status == b.sensor.status && a.truth.dtheta_arcsec == b.truth.dtheta_arcsec &&
           a.truth.detuning_end_lambda == b.truth.detuning_end_lambda;
}

void expect_same(const TwinConfig& with, const TwinConfig& without, int n_halves) {
    Twin a{with, Motion::sines(5000.0, {})};
    Twin b{without, Motion::sines(5000.0, {})};
    for (int h = 0; h < n_halves; ++h) {
        const auto command = frame(h % 100 > 6, h / 100 % 2 == 0 ? 1 : -1, 150.0 + 40.0 * (h / 100 % 2));
        ASSERT_TRUE(same_bits(a.advance(command), b.advance(command))) << "half " << h;
    }
}

TEST(Faults, NoneChangesNothingBeforeItBegins) {
    for (const Fidelity fidelity : {Fidelity::averaged, Fidelity::laser}) {
        TwinConfig without;
        without.gyro.fidelity = fidelity;
        without.gyro.bias_temperature_coefficient_per_c = -5e-4;
        for (const FaultKind kind : all_fault_kinds) {
            // Its table must reach farther from the start on; its light is the same to 1e-4 only.
            if (fidelity == Fidelity::laser && kind != FaultKind::shock) continue;
            TwinConfig with = without;
            with.faults = {random_fault(kind, 1.0, 3)};
            expect_same(with, without, 399);
        }
    }
}

TEST(Faults, EachKindMakesADifferenceAndTheSameAgain) {
    for (const FaultKind kind : all_fault_kinds) {
        // At an opening of the loop, and long enough to hold one.
        Fault fault = random_fault(kind, 0.4 * half_s, 5);
        fault.duration_s = std::max(fault.duration_s, 1.5);
        if (kind == FaultKind::overspeed) fault.size = std::copysign(fault.size, 1.0);
        TwinConfig with;
        with.faults = {fault};
        with.counter_max_hz = 502e3;
        TwinConfig without;
        without.counter_max_hz = 502e3;
        Twin a{with, Motion::rest()};
        Twin again{with, Motion::rest()};
        Twin b{without, Motion::rest()};
        bool differs = false;
        for (int h = 0; h < 600; ++h) {
            const auto command = frame(h % 200 > 6, h / 200 % 2 == 0 ? 1 : -1, 150.0 + 40.0 * (h / 200 % 2));
            const TwinHalf one = a.advance(command);
            const TwinHalf two = again.advance(command);
            // A difference from itself where a field is NaN is none.
            const auto has_nan = [](const auto& samples) {
                return std::ranges::any_of(samples, [](float x) { return std::isnan(x); });
            };
            if (!has_nan(one.sensor.light_a) && !std::isnan(one.sensor.piezo_v) &&
                !std::isnan(one.sensor.temperature_c))
                ASSERT_TRUE(same_bits(one, two)) << facts(kind).name;
            if (!same_bits(one, b.advance(command))) differs = true;
        }
        EXPECT_TRUE(differs) << facts(kind).name;
    }
}

TEST(Faults, ALaserObeysTheSameFaults) {
    const auto simulate = [](std::vector<Fault> faults) {
        TwinConfig config = quiet_gyro();
        config.gyro.fidelity = Fidelity::laser;
        config.faults = std::move(faults);
        Twin twin{config, Motion::rest()};
        return advance(twin, frame(true, 1), 12);
    };
    const auto good = simulate({});
    const auto off = simulate({{FaultKind::laser_off, 4 * half_s, 4 * half_s, 0.0}});
    EXPECT_TRUE(off[3].truth.lit);
    EXPECT_FALSE(off[5].truth.lit);
    EXPECT_TRUE(off[9].truth.lit);
    EXPECT_NEAR(off[5].sensor.light_a[3], 0.0, 1e-3);
    const auto lost = simulate({{FaultKind::bias_lost, 4 * half_s, 4 * half_s, 0.5}});
    // f0 is proportional to the field within some per cent.
    EXPECT_NEAR(static_cast<double>(counts(lost, 6)) / static_cast<double>(counts(good, 6)), 0.5, 0.03);
    const auto skewed = simulate({{FaultKind::bias_asymmetric, 4 * half_s, 4 * half_s, 0.1}});
    EXPECT_NEAR(static_cast<double>(counts(skewed, 6)) / static_cast<double>(counts(good, 6)), 1.1, 0.02);
    const auto faded = simulate({{FaultKind::beam_fades, 4 * half_s, 4 * half_s, 1.0}});
    EXPECT_LT(light_ratio(faded[5].sensor, 15), 0.05);
    EXPECT_NEAR(light_ratio(faded[9].sensor, 0), light_ratio(good[9].sensor, 0), 1e-6);
}

TEST(Faults, RandomOnesAreAllowed) {
    for (const FaultKind kind : all_fault_kinds) {
        const FaultFacts& f = facts(kind);
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            const Fault fault = random_fault(kind, 1.5, seed);
            ASSERT_EQ(fault.kind, kind);
            ASSERT_EQ(fault.at_s, 1.5);
            ASSERT_TRUE(fault.duration_s >= f.random_s.least && fault.duration_s <= f.random_s.most) << f.name;
            ASSERT_TRUE(fault.size >= f.size.least && fault.size <= f.size.most) << f.name;
            ASSERT_TRUE(std::abs(fault.size) >= f.random_size.least && std::abs(fault.size) <= f.random_size.most)
                << f.name;
        }
    }
}

TEST(Faults, RandomOnesComeAsOftenAsAskedAndFromTheirSeed) {
    const auto faults = random_faults(360.0, 1e5, 7, {});
    // 10 000 expected, with a standard deviation of 100.
    EXPECT_NEAR(static_cast<double>(faults.size()), 1e4, 400.0);
    EXPECT_TRUE(std::ranges::is_sorted(faults, {}, &Fault::at_s));
    std::vector<int> of_kind(n_fault_kinds);
    for (const Fault& f : faults) ++of_kind[static_cast<std::size_t>(f.kind)];
    for (const int n : of_kind) EXPECT_NEAR(n, 1e4 / 26.0, 100.0);
    const auto again = random_faults(360.0, 1e5, 7, {});
    ASSERT_EQ(again.size(), faults.size());
    EXPECT_TRUE(std::ranges::equal(again, faults, {}, &Fault::size, &Fault::size));
    EXPECT_NE(random_faults(360.0, 1e5, 8, {}).front().at_s, faults.front().at_s);
    const std::vector only{FaultKind::shock};
    for (const Fault& f : random_faults(360.0, 1e4, 7, only)) EXPECT_EQ(f.kind, FaultKind::shock);
    EXPECT_TRUE(random_faults(0.0, 1e5, 7, {}).empty());
    EXPECT_THROW((void)random_faults(-1.0, 1e5, 7, {}), std::invalid_argument);
    EXPECT_THROW((void)random_faults(std::nan(""), 1e5, 7, {}), std::invalid_argument);
    EXPECT_THROW((void)random_faults(1e9, 1e9, 7, {}), std::invalid_argument);
}

std::string complaint(const Fault& fault, Loop loop = Loop::analog) {
    TwinConfig config = quiet_gyro();
    config.perimeter.loop = loop;
    config.faults = {fault};
    return test::refusal_by<std::invalid_argument>([&] { Twin twin{config, Motion::rest()}; });
}

TEST(Faults, AHundredMayActAtOnce) {
    const auto refusal = [](std::vector<Fault> faults) -> std::string {
        TwinConfig config;
        config.faults = std::move(faults);
        return test::refusal_by<std::invalid_argument>([&] { Twin twin{config, Motion::rest()}; });
    };
    std::vector<Fault> at_once;
    for (std::size_t k = 0; k < max_faults_at_once; ++k)
        at_once.push_back({FaultKind::light_noisy, 3.0 - 1e-3 * static_cast<double>(k), 1.0, 0.0});
    EXPECT_EQ(refusal(at_once), "");
    at_once.push_back({FaultKind::light_noisy, 4.0 - 1e-3, 1.0, 0.0});
    EXPECT_EQ(refusal(at_once), "") << "those that are over do not count";
    at_once.push_back({FaultKind::shock, 3.0, 0.0, 0.0});
    test::expect_contains(refusal(at_once), "more than 100 act at once at 3 s");
}

TEST(Faults, WhatCannotBeIsRefused) {
    EXPECT_EQ(complaint({FaultKind::beam_fades, 1.0, 1.0, 1.5}),
              "fault beam_fades: faults.size is 1.5, allowed is 0..1");
    EXPECT_NE(complaint({FaultKind::shock, 0.0, 1.0, std::nan("")}), "");
    EXPECT_NE(complaint({FaultKind::counter_bit_stuck, 0.0, 1.0, 64.0}), "");
    test::expect_contains(complaint({FaultKind::mode_hop, 0.0, 1.0, 0.5}, Loop::exponential), "exponential loop");
    EXPECT_EQ(complaint({FaultKind::frame_late, 0.0, 1.0, 0.0}, Loop::exponential), "");
    EXPECT_EQ(complaint({FaultKind::mode_hop, 0.0, 1.0, 0.5}), "");
}

}  // namespace zlg::twin::faults_test
