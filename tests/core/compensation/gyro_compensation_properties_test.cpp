// Properties of the whole compensation, on logs that RapidCheck makes up and makes small where one of them fails.
#include <zlg/core/gyro_compensation.hpp>

#include <rapidcheck/gtest.h>

#include "gyro_compensation_support.hpp"

namespace zlg::core::gyro_compensation_properties_test {

using namespace gyro_compensation_support;

// Ticks that are measured and ticks of a gap, in turn.
using Plan = std::vector<std::pair<int, int>>;

// A whole number; RapidCheck's own begin with the smallest ones.
int any(int from, int to) { return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(from, to + 1)); }

Plan any_plan(int longest_gap) {
    return *rc::gen::container<Plan>(rc::gen::pair(rc::gen::inRange(1, 14), rc::gen::inRange(1, longest_gap + 1)));
}

std::size_t n_ticks_of(const Plan& plan) {
    int n = 0;
    for (const auto& [measured, gap] : plan) n += measured + gap;
    return static_cast<std::size_t>(n);
}

std::vector<int> any_counts(std::size_t n_halves, int most = 1000) {
    return *rc::gen::container<std::vector<int>>(n_halves, rc::gen::inRange(-most, most + 1));
}

// The plan, with `around` measured ticks before it and after it; a gap is a switch. counts: two for each tick.
Halves log_of(const Plan& plan, std::size_t around, const std::vector<int>& counts) {
    std::vector<bool> closed(around, true);
    for (const auto& [measured, gap] : plan) {
        closed.insert(closed.end(), static_cast<std::size_t>(measured), true);
        closed.insert(closed.end(), static_cast<std::size_t>(gap), false);
    }
    closed.insert(closed.end(), around, true);
    Halves halves(2 * closed.size());
    std::int8_t mode = 1;
    for (std::size_t k = 0; k < halves.size(); ++k) {
        if (k % 2 == 0 && k > 0 && !closed[k / 2] && closed[k / 2 - 1]) mode = static_cast<std::int8_t>(-mode);
        halves[k] = {.half = static_cast<std::int64_t>(k),
                     .counts = counts[k],
                     .detuning_lambda = not_a_number,
                     .detuning_sq_lambda2 = not_a_number,
                     .piezo_v = not_a_number,
                     .temperature_c = not_a_number,
                     .bias_sign = k % 2 == 0 ? std::int8_t{1} : std::int8_t{-1},
                     .mode = mode,
                     .loop_closed = closed[k / 2]};
    }
    return halves;
}

Halves any_log(int longest_gap, std::size_t around) {
    const Plan plan = any_plan(longest_gap);
    return log_of(plan, around, any_counts(2 * (n_ticks_of(plan) + 2 * around)));
}

// Detuning of any size in some halves, so that all corrections of the false drift have work, and some refuse it.
void spread_detuning(Halves& halves) {
    for (HalfRecord& half : halves) {
        const int milli = any(-100, 250);
        if (milli < -50) continue;
        half.detuning_lambda = 1e-3 * milli;
        half.detuning_sq_lambda2 = 1e-6 * milli * milli;
        half.temperature_c = 20.0 + milli;
    }
}

GyroCompensationConfig any_config(BridgeMethod bridge, bool with_relock) {
    GyroCompensationConfig c;
    c.relock.method = with_relock ? static_cast<RelockMethod>(any(0, 4)) : RelockMethod::none;
    c.relock.ticks = any(0, 30);
    c.gyro.bias = Hertz{2e3};
    // No law of the counts: it is not linear in them.
    if (with_relock) c.lock_in = {.threshold = Hertz{1.0 * any(0, 100)}, .sigma = Hertz{1.0 * any(0, 100)}};
    c.bridge.method = bridge;
    const int order = order_of(bridge);
    c.bridge.extrapolation_points = any(order + 1, 8);
    c.bridge.points_before = any(1, 8);
    c.bridge.points_after = any(order == 2 && c.bridge.points_before == 1 ? 2 : 1, 8);
    RC_ASSERT(check(c) == GyroCompensationFault::none);
    return c;
}

BridgeMethod any_bridge() { return static_cast<BridgeMethod>(any(0, 4)); }

// That remembers no motion.
BridgeMethod any_fixed_bridge() { return static_cast<BridgeMethod>(any(0, 3)); }
BridgeMethod any_polynomial() { return static_cast<BridgeMethod>(any(1, 3)); }

bool near(double a, double b) { return std::fabs(a - b) < 1e-6; }

// Rows scaled by a factor; sigma is not, because it speaks of the counter.
bool is_scaled(const AngleRow& scaled, const AngleRow& row, double factor) {
    return scaled.dtheta_arcsec == factor * row.dtheta_arcsec &&
           scaled.dtheta_final_arcsec == factor * row.dtheta_final_arcsec && scaled.sigma_arcsec == row.sigma_arcsec &&
           scaled.flags == row.flags;
}

RC_GTEST_PROP(GyroCompensationProperty, CountsTimesAPowerOfTwoOrNegatedScaleEveryBit, ()) {
    const GyroCompensationConfig config = any_config(any_fixed_bridge(), false);
    Halves halves = any_log(20, 3);
    const Delivered plain = run(config, halves);
    const int factor = (1 << any(0, 20)) * *rc::gen::element(1, -1);
    for (HalfRecord& half : halves) half.counts *= factor;
    const Delivered scaled = run(config, halves);
    RC_ASSERT(scaled.rows.size() == plain.rows.size());
    for (std::size_t k = 0; k < plain.rows.size(); ++k) RC_ASSERT(is_scaled(scaled.rows[k], plain.rows[k], factor));
}

// Weights far ahead of few points go up to some hundreds; the counts are 1000 at most.
RC_GTEST_PROP(GyroCompensationProperty, RotationsAddUp, ()) {
    const GyroCompensationConfig config = any_config(any_fixed_bridge(), false);
    const Plan plan = any_plan(20);
    const std::size_t n_halves = 2 * (n_ticks_of(plan) + 6);
    const std::vector<int> a = any_counts(n_halves);
    const std::vector<int> b = any_counts(n_halves);
    std::vector<int> sum(n_halves);
    for (std::size_t k = 0; k < n_halves; ++k) sum[k] = a[k] + b[k];
    const Delivered of_a = run(config, log_of(plan, 3, a));
    const Delivered of_b = run(config, log_of(plan, 3, b));
    const Delivered of_sum = run(config, log_of(plan, 3, sum));
    for (std::size_t k = 0; k < of_sum.rows.size(); ++k) {
        const AngleRow &got = of_sum.rows[k], &first = of_a.rows[k], &second = of_b.rows[k];
        RC_ASSERT(near(got.dtheta_arcsec - first.dtheta_arcsec, second.dtheta_arcsec));
        RC_ASSERT(near(got.dtheta_final_arcsec - first.dtheta_final_arcsec, second.dtheta_final_arcsec));
    }
}

RC_GTEST_PROP(GyroCompensationProperty, ALogPlayedBackwardsHasItsFinalAnglesBackwards, ()) {
    GyroCompensationConfig config = any_config(any_polynomial(), false);
    config.bridge.points_before = config.bridge.points_after = any(2, 8);
    Halves halves = any_log(16, 8);
    const Delivered forward = run(config, halves);
    std::reverse(halves.begin(), halves.end());
    Delivered backward = run(config, halves);
    std::reverse(backward.rows.begin(), backward.rows.end());
    for (std::size_t k = 0; k < forward.rows.size(); ++k) {
        RC_ASSERT(near(forward.rows[k].dtheta_final_arcsec, backward.rows[k].dtheta_final_arcsec));
        // Equal to rounding.
        RC_ASSERT(near(forward.rows[k].sigma_arcsec, backward.rows[k].sigma_arcsec));
    }
}

// A log that starts with a settled loop: of another one the start itself says something.
void settle_start(Halves& halves) {
    for (HalfRecord& half : halves) {
        if (!half.loop_closed || !half.valid) return;
        half.detuning_lambda = half.detuning_sq_lambda2 = 0.0;
    }
}

// Eight measured ticks stand before the first gap, so that no fit reaches what is put before them.
RC_GTEST_PROP(GyroCompensationProperty, AnEarlierStartOfTheLogChangesNoBitOfWhatFollows, ()) {
    const GyroCompensationConfig config = any_config(any_fixed_bridge(), true);
    Halves halves = any_log(20, 8);
    spread_detuning(halves);
    settle_start(halves);
    const Delivered plain = run(config, halves);
    const auto earlier = static_cast<std::size_t>(any(1, 200));
    Halves whole = log_of({}, 0, {});
    for (std::size_t k = 0; k < 2 * earlier; ++k) {
        whole.push_back({.counts = any(-1000, 1000), .bias_sign = k % 2 == 0 ? std::int8_t{1} : std::int8_t{-1}});
    }
    whole.insert(whole.end(), halves.begin(), halves.end());
    const auto first_half = *rc::gen::arbitrary<std::int32_t>();
    for (std::size_t k = 0; k < whole.size(); ++k) whole[k].half = first_half + static_cast<std::int64_t>(k);
    const Delivered got = run(config, whole);
    RC_ASSERT(got.rows.size() == plain.rows.size() + earlier);
    for (std::size_t k = 0; k < plain.rows.size(); ++k) {
        AngleRow row = got.rows[k + earlier];
        row.tick -= static_cast<std::int64_t>(earlier);
        RC_ASSERT(row == plain.rows[k]);
    }
}

RC_GTEST_PROP(GyroCompensationProperty, ACopyOfTheStateGoesOnWithTheSameBits, ()) {
    const GyroCompensationConfig config = any_config(any_bridge(), true);
    Halves halves = any_log(20, 2);
    spread_detuning(halves);
    for (HalfRecord& half : halves) half.edge_offset_ticks = any(-170, 170);
    const auto cut = static_cast<std::size_t>(any(0, static_cast<int>(halves.size())));
    GyroCompensationState state;
    Delivered first;
    for (std::size_t k = 0; k < cut; ++k) step_into(config, state, halves[k], first);
    GyroCompensationState copy = state;
    Delivered second = first;
    for (std::size_t k = cut; k < halves.size(); ++k) {
        step_into(config, state, halves[k], first);
        step_into(config, copy, halves[k], second);
        RC_ASSERT(copy == state);
    }
    drain_into(config, state, first);
    drain_into(config, copy, second);
    RC_ASSERT(first.rows == second.rows);
    RC_ASSERT(first.gaps == second.gaps);
}

bool nothing_is_owed(const GyroCompensationState& s) {
    return s.bridge.n_pending == 0 && !s.bridge.gap.open && !s.first_waits;
}

// What would be missing if the log ended here: final minus delivered, from its start.
Quad missing_arcsec(const GyroCompensationConfig& config, GyroCompensationState state, Delivered so_far) {
    drain_into(config, state, so_far);
    Quad missing = 0;
    for (const AngleRow& row : so_far.rows) missing += Quad{row.dtheta_final_arcsec} - Quad{row.dtheta_arcsec};
    return missing;
}

RC_GTEST_PROP(GyroCompensationProperty, AfterEveryCorrectionNothingOfTheAngleIsMissing, ()) {
    const GyroCompensationConfig config = any_config(any_bridge(), true);
    // The last correction is due within 30 + 16 ticks of its gap.
    Halves halves = any_log(40, 64);
    spread_detuning(halves);
    GyroCompensationState state;
    Delivered so_far;
    for (const HalfRecord& half : halves) {
        const std::size_t n_before = so_far.samples.size();
        step_into(config, state, half, so_far);
        if (so_far.samples.size() == n_before) continue;
        const bool corrected = (so_far.samples.back().sample.flags & flag_correction) != 0;
        if (corrected && nothing_is_owed(state))
            RC_ASSERT(magnitude(missing_arcsec(config, state, so_far)) < Quad{1e-9});
    }
    RC_ASSERT(nothing_is_owed(state));
    RC_ASSERT(magnitude(missing_arcsec(config, state, so_far)) < Quad{1e-9});
}

// Any double: any sign, exponent and mantissa, and what is none.
double any_double() {
    const std::vector<double> special{0.0, -0.0, infinite, -infinite, not_a_number, 5e-324, 1.7e308, 1.0};
    return *rc::gen::weightedOneOf<double>(
        {{1, rc::gen::elementOf(special)}, {3, rc::gen::map(rc::gen::arbitrary<std::uint64_t>(), [](std::uint64_t b) {
                                                return std::bit_cast<double>(b);
                                            })}});
}

HalfRecord any_half() {
    return {.half = *rc::gen::arbitrary<std::int64_t>(),
            .counts = *rc::gen::arbitrary<std::int64_t>() >> any(0, 63),
            .detuning_lambda = any_double(),
            .detuning_sq_lambda2 = any_double(),
            .piezo_v = any_double(),
            .temperature_c = any_double(),
            .bias_sign = *rc::gen::arbitrary<std::int8_t>(),
            .mode = *rc::gen::arbitrary<std::int8_t>(),
            .loop_closed = any(0, 7) > 0,
            .valid = any(0, 15) > 0};
}

// A positive number of the configuration: as it is, an end of what `check` lets pass, or from between, of any
// magnitude.
template <class Set> void vary(GyroCompensationConfig& config, double least, double most, Set set) {
    const int place = any(-200, 150);  // in hundredths of the way, beyond the ends: an end
    if (place < -100) return;
    const double part = std::fmin(std::fmax(0.01 * place, 0.0), 1.0);
    set(config, part == 1.0 ? most : least * std::pow(most / least, part));
    RC_ASSERT(check(config) == GyroCompensationFault::none);
}

GyroCompensationConfig any_checked_config() {
    GyroCompensationConfig c = any_config(any_bridge(), true);
    const double sign = any(0, 1) == 0 ? 1.0 : -1.0;
    vary(c, 1e-9, 1e9, [](auto& v, double x) {
        v.gyro.tick = Seconds{x};
        if (final_delay_ticks(v.gyro, bridge_of(v)) > most_final_delay_ticks) v.bridge.method = BridgeMethod::quadratic;
    });
    vary(c, 1e-9, 1e9, [](auto& v, double x) { v.gyro.scale = Arcsec{x}; });
    vary(c, 1e-290, 1e15, [](auto& v, double x) { v.gyro.bias = Hertz{x}; });
    vary(c, 1e-290, 1e6, [](auto& v, double x) { v.gyro.chi = x; });
    vary(c, 1e-290, 1.0, [sign](auto& v, double x) { v.gyro.temperature_coefficient_per_c = sign * x; });
    vary(c, 1e-290, 1e6, [sign](auto& v, double x) { v.gyro.reference_temperature = Celsius{sign * x}; });
    vary(c, 1e-290, 10.0, [](auto& v, double x) { v.gyro.light_noise = Wavelengths{x}; });
    vary(c, 1e-290, 1e6, [](auto& v, double x) { v.gyro.random_walk = ArcsecPerRootSecond{x}; });
    return c;
}

RC_GTEST_PROP(GyroCompensationProperty, NothingThatComesOutIsNotANumberWhateverGoesIn, ()) {
    const GyroCompensationConfig config = any_checked_config();
    const int n_halves = any(2, 600);
    GyroCompensationState state;
    Delivered got;
    for (int k = 0; k < n_halves; ++k) step_into(config, state, any_half(), got);
    RC_ASSERT(state == GyroCompensationState{state});
    drain_into(config, state, got);
    RC_ASSERT(got.rows.size() == static_cast<std::size_t>(n_halves / 2));
    for (const CompensationOutput& out : got.samples) {
        RC_ASSERT(std::isfinite(out.sample.dtheta_arcsec) && std::isfinite(out.angle_arcsec));
    }
    std::int64_t tick = 0;
    for (const AngleRow& row : got.rows) {
        RC_ASSERT(row.tick == tick++ && (row.mode == 1 || row.mode == -1));
        RC_ASSERT(std::isfinite(row.dtheta_arcsec) && std::isfinite(row.dtheta_final_arcsec));
        RC_ASSERT(row.sigma_arcsec >= 0.0 && std::isfinite(row.relock_arcsec));
    }
    for (const GapReport& gap : got.gaps) RC_ASSERT(std::isfinite(gap.dp_arcsec) && gap.sigma_sum_arcsec >= 0.0);
}

}  // namespace zlg::core::gyro_compensation_properties_test
