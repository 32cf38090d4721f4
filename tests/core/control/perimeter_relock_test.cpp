#include <zlg/core/control/perimeter_loop.hpp>

#include "support.hpp"

namespace zlg::core::perimeter_relock_test {

constexpr PerimeterLoopConfig relocking{.kind = LoopKind::digital, .time_constant = Seconds{0.025}, .relock_halves = 4};

constexpr bool allows(auto change) { return test::allows<PerimeterLoopConfig>(change); }
static_assert(is_allowed(relocking));
static_assert(!allows([](auto& c) { c.relock_halves = -1; }));
static_assert(!allows([](auto& c) { c.relock_gain = 0.0; }));
static_assert(!allows([](auto& c) { c.relock_gain = not_a_number; }));
static_assert(!allows([](auto& c) { c.stage_time_constant = Seconds{0.0}; }));
static_assert(!allows([](auto& c) { c.set_points = 17; }));

// A stage and a mode 0.0125 wavelength per volt away from `centre_v`, in small steps of Euler's rule.
struct Plant {
    double v = 150.0;
    double centre_v = 150.0;
    double slew_v_s = 4000.0;
    double injected_v = 0.0;

    // Mean detuning of a half under these set-points.
    double advance(const PerimeterLoopOutput& o) {
        constexpr int steps = 1600;
        double sum = 0.0;
        for (int k = 0; k < steps; ++k) {
            const double command_v = o.set_point_v[static_cast<std::size_t>(k * o.n_set_points / steps)] + injected_v;
            sum += 0.0125 * (v - centre_v);
            v += 0.0025 / steps * std::clamp((command_v - v) / 0.001, -slew_v_s, slew_v_s);
        }
        return sum / steps;
    }
};

// Detunings of the halves after closing, the last of them in the open loop. `gain` is that of the light's reading.
std::vector<double> relock(const PerimeterLoopConfig& c, double miss, double gain, bool light_in_gap = true) {
    Plant plant;
    PerimeterLoopState s = initial_state(c, Volts{150.0});
    plant.centre_v = 190.0 - 80.0 * miss;
    PerimeterLoopInput in{.was_closed = true, .close = false, .second_input = Volts{190.0}};
    PerimeterLoopOutput out;
    double dl = 0.0;
    for (int h = 0; h < 6; ++h) {
        out = step(c, s, in);
        in.was_closed = false;
        dl = plant.advance(out);
    }
    std::vector<double> means;
    for (int h = 0; h < 12; ++h) {
        in.close = true;
        in.usable = h > 0 || light_in_gap;
        in.detuning = Wavelengths{gain * dl};
        out = step(c, s, in);
        in.was_closed = true;
        dl = plant.advance(out);
        means.push_back(dl);
    }
    return means;
}

TEST(PerimeterRelock, LocksWithinTwoTicksWithThirtyPercentOfGainError) {
    for (const double gain : {0.7, 1.0, 1.3}) {
        for (const double miss : {0.05, -0.05}) {
            const std::vector<double> dl = relock(relocking, miss, gain);
            EXPECT_LE(std::abs(dl[0]), 0.042) << gain;
            EXPECT_LE(std::abs(dl[1]), 0.013) << gain;
            EXPECT_LE(std::abs(dl[3]), 0.003) << gain;
        }
    }
}

TEST(PerimeterRelock, TheFirstCorrectionTakesItsPartOfTheMissWhateverIsInFlight) {
    PerimeterLoopConfig all = relocking;
    all.relock_gain = 1.0;
    // With a gain of one and a true model, nothing is left once the voltage has moved.
    const std::vector<double> dl = relock(all, 0.05, 1.0);
    EXPECT_LT(std::abs(dl[1]), 2e-4);
    EXPECT_LT(std::abs(dl[2]), 2e-4);
}

TEST(PerimeterRelock, WithoutLightInTheGapItBeginsOneHalfLater) {
    const std::vector<double> dl = relock(relocking, 0.05, 1.0, false);
    EXPECT_NEAR(dl[0], 0.05, 1e-3);
    EXPECT_LT(std::abs(dl[3]), 0.002);
}

TEST(PerimeterRelock, AMoveThatIsStillUnderWayTellsNothingOfTheNewMode) {
    PerimeterLoopState s = initial_state(relocking, Volts{150.0});
    PerimeterLoopInput in{.was_closed = false, .close = false, .second_input = Volts{190.0}};
    (void)step(relocking, s, in);
    in.close = true;
    in.usable = true;
    in.detuning = Wavelengths{0.1};
    (void)step(relocking, s, in);
    EXPECT_EQ(s.set_point_v, 190.0);
}

TEST(PerimeterRelock, SlowsDownAfterItsHalves) {
    PerimeterLoopState s = initial_state(relocking, Volts{150.0});
    PerimeterLoopInput in{.usable = true, .detuning = Wavelengths{0.01}};
    double last_v = 150.0;
    for (int h = 0; h < 8; ++h) {
        s.mean_v = s.end_v = s.set_point_v;  // nothing in flight
        (void)step(relocking, s, in);
        EXPECT_NEAR(last_v - s.set_point_v, 0.8 * (h < 4 ? 0.87 : 0.1), 1e-12) << h;
        last_v = s.set_point_v;
    }
}

TEST(PerimeterRelock, ThePlainIntegratorAndTheAnalogLoopGiveOneSetPoint) {
    for (const LoopKind kind : {LoopKind::digital, LoopKind::analog}) {
        PerimeterLoopConfig c;
        c.kind = kind;
        PerimeterLoopState s = initial_state(c, Volts{150.0});
        const PerimeterLoopOutput out = step(c, s, {.usable = true, .detuning = Wavelengths{0.01}});
        EXPECT_EQ(out.n_set_points, 1);
        EXPECT_EQ(out.set_point_v[0], s.set_point_v);
    }
}

// A gap of three ticks, 40 V, by a stage whose slew is another than presumed: what is learnt of it.
double learnt_slew_v_s(const PerimeterLoopConfig& c, double true_slew_v_s, int switches, double injected_v = 0.0) {
    PerimeterLoopState s = initial_state(c, Volts{150.0});
    Plant plant{.slew_v_s = true_slew_v_s, .injected_v = injected_v};
    for (int n = 0; n < switches; ++n) {
        const Volts target{n % 2 == 0 ? 190.0 : 150.0};
        for (int h = 0; h < 10; ++h) {
            const bool closes = h >= 6;
            const PerimeterLoopOutput out =
                step(c, s,
                     {.was_closed = h == 0 || h > 6, .close = closes, .second_input = target, .piezo = Volts{plant.v}});
            if (!closes) (void)plant.advance(out);
        }
    }
    return s.slew_ratio * c.slew_v_s;
}

TEST(PerimeterRelock, TheSpeedOfTheStageIsLearntFromSwitchToSwitch) {
    PerimeterLoopConfig analog;
    for (const double slew_v_s : {3000.0, 4000.0, 5500.0}) {
        EXPECT_NEAR(learnt_slew_v_s(analog, slew_v_s, 14), slew_v_s, 0.03 * slew_v_s);
        EXPECT_NEAR(learnt_slew_v_s(relocking, slew_v_s, 14), slew_v_s, 0.03 * slew_v_s);
    }
}

TEST(PerimeterRelock, AVoltageThatIsLedAwayByOthersTeachesNothingOfTheStage) {
    EXPECT_EQ(learnt_slew_v_s(PerimeterLoopConfig{}, 4000.0, 6, -17.0), 4000.0);
}

TEST(PerimeterRelock, AnOpenLoopArrivesAsSoonAsTheCurrentAllowsAndStays) {
    PerimeterLoopConfig analog;
    PerimeterLoopState s = initial_state(analog, Volts{150.0});
    Plant plant;
    PerimeterLoopInput in{.close = false, .second_input = Volts{190.0}, .piezo = Volts{150.0}};
    // 40 V at 4 V/ms: four halves.
    for (int h = 0; h < 4; ++h) {
        (void)plant.advance(step(analog, s, in));
        in = {.was_closed = false, .close = false, .second_input = Volts{190.0}, .piezo = Volts{plant.v}};
    }
    // Only the last piece of a half is not led, 0.156 ms.
    EXPECT_NEAR(plant.v, 190.0, 0.625);
    (void)plant.advance(step(analog, s, in));
    EXPECT_NEAR(plant.v, 190.0, 0.05);
}

TEST(PerimeterRelock, NothingButFiniteSetPointsWithinTheRangeComesOut) {
    PerimeterLoopState s = initial_state(relocking, Volts{150.0});
    for (const double dl : {not_a_number, 1e300, -1e300, 0.3, -0.3, not_a_number, 1e308, -1e308, 0.0}) {
        const PerimeterLoopOutput out = step(relocking, s, {.usable = true, .detuning = Wavelengths{dl}});
        for (const double v : out.set_point_v) EXPECT_TRUE(v >= 0.0 && v <= 300.0) << v;
        EXPECT_TRUE(std::isfinite(s.end_v) && std::isfinite(s.mean_v));
    }
}

}  // namespace zlg::core::perimeter_relock_test
