#include <zlg/trials/scenarios.hpp>

#include <array>
#include <cstddef>

#include <fmt/format.h>

#include <zlg/chance/draw.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/twin/fault_kinds.hpp>

namespace zlg::trials {
namespace {

using chance::Draws;

constexpr std::array relocks{core::RelockMethod::none, core::RelockMethod::frequency, core::RelockMethod::detuning,
                             core::RelockMethod::mean_square, core::RelockMethod::joint};
constexpr std::array bridges{core::BridgeMethod::none, core::BridgeMethod::constant, core::BridgeMethod::linear,
                             core::BridgeMethod::quadratic, core::BridgeMethod::automatic};
constexpr std::array dithers{core::DitherMethod::none, core::DitherMethod::automatic, core::DitherMethod::paired,
                             core::DitherMethod::random};
constexpr std::array magnetics{core::MagneticMethod::none, core::MagneticMethod::watch, core::MagneticMethod::estimate};
// The twin's third loop is a formula that no fault moves, and the same as the first to the core.
constexpr std::array loops{config::Loop::analog, config::Loop::digital};
constexpr std::array schedules{config::Schedule::fixed, config::Schedule::measured};

void draw_gyro(const Draws& draws, config::Config& c) {
    c.run.seed = draws.of("run.seed").below(1'000'000'000);
    c.gyro.first_bias_sign = draws.of("gyro.first_bias_sign").is_one_in(2) ? 1 : -1;
    c.gyro.light_samples = draws.of("gyro.light_samples").one_of(std::array{1, 4, 16, 16, 64});
    // Only a laser has a lock-in against which its bias can be shifted.
    const core::DitherMethod dither = draws.of("gyro.dither").one_of(dithers);
    if (draws.of("gyro.fidelity").is_one_in(6)) {
        c.gyro.fidelity = config::Fidelity::laser;
        c.gyro.dither = dither;
    }
    c.gyro.bias_temperature_coefficient_per_c =
        draws.of("gyro.bias_temperature_coefficient_per_c, which").is_one_in(2)
            ? 0.0
            : draws.of("gyro.bias_temperature_coefficient_per_c").within(-1e-4, 1e-4);
    c.perimeter.loop = draws.of("perimeter.loop").one_of(loops);
    c.perimeter.relock_halves = draws.of("perimeter.relock_halves").is_one_in(2) ? 4 : 0;
    c.perimeter.miss_lambda = draws.of("perimeter.miss_lambda, which").is_one_in(2)
                                  ? 0.0
                                  : draws.of("perimeter.miss_lambda").within(0.05, 0.24);
    c.piezo.half_wave_error = draws.of("piezo.half_wave_error").within(-0.02, 0.02);
    if (draws.of("ideal piezo").is_one_in(2)) return;
    c.piezo.hysteresis = 0.12;
    c.piezo.creep_per_decade = 0.015;
}

void draw_switching(const Draws& draws, config::Config& c) {
    c.switching.interval_s = draws.of("switching.interval_s").within(1.0, 9.0);
    c.switching.first_segment =
        draws.of("switching.first_segment").is_one_in(2) ? config::FirstSegment::full : config::FirstSegment::half;
    c.switching.schedule = draws.of("switching.schedule").one_of(schedules);
    c.switching.interval_min_s = 1.0;
    c.switching.interval_max_s = 10.0;
    c.switching.gap_ticks =
        static_cast<int>(1 + draws.of("switching.gap_ticks").below(draws.of("long gap").is_one_in(4) ? 16 : 5));
}

void draw_compensation(const Draws& draws, config::Config& c) {
    c.compensation.relock = draws.of("compensation.relock").one_of(relocks);
    c.compensation.bridge = draws.of("compensation.bridge").one_of(bridges);
    c.compensation.relock_ticks = static_cast<int>(1 + draws.of("compensation.relock_ticks").below(30));
    c.compensation.extrapolation_points = static_cast<int>(3 + draws.of("compensation.extrapolation_points").below(6));
    c.compensation.points_before = static_cast<int>(2 + draws.of("compensation.points_before").below(4));
    c.compensation.points_after = static_cast<int>(2 + draws.of("compensation.points_after").below(4));
    c.compensation.magnetic = draws.of("compensation.magnetic").one_of(magnetics);
}

void draw_motion(const Draws& draws, config::Config& c) {
    c.motion.kind = draws.of("motion.kind")
                        .one_of(std::array{config::MotionKind::rest, config::MotionKind::constant,
                                           config::MotionKind::sine, config::MotionKind::sum});
    const bool is_constant = c.motion.kind == config::MotionKind::constant;
    c.motion.rate_arcsec_s = is_constant ? draws.of("motion.rate_arcsec_s").within(-100'000.0, 100'000.0) : 0.0;
    c.motion.amplitude_arcsec_s = {draws.of("motion.amplitude_arcsec_s").within(10.0, 12'000.0)};
    c.motion.frequency_hz = {draws.of("motion.frequency_hz").within(0.05, 12.0)};
    if (c.motion.kind != config::MotionKind::sum) return;
    c.motion.amplitude_arcsec_s.push_back(draws.of("second motion.amplitude_arcsec_s").within(10.0, 3'000.0));
    c.motion.frequency_hz.push_back(draws.of("second motion.frequency_hz").within(0.05, 60.0));
    c.motion.phase_deg.push_back(draws.of("second motion.phase_deg").within(0.0, 360.0));
}

// One in three reads the phase of the fringe, with photodiodes good or bad.
void draw_readout(const Draws& draws, config::Config& c) {
    if (!draws.of("gyro.readout").is_one_in(3)) return;
    c.gyro.readout = config::Readout::phase;
    c.photodiodes.offset_cosine = draws.of("photodiodes.offset_cosine").within(-0.1, 0.1);
    c.photodiodes.offset_sine = draws.of("photodiodes.offset_sine").within(-0.1, 0.1);
    c.photodiodes.amplitude_error = draws.of("photodiodes.amplitude_error").within(-0.1, 0.1);
    c.photodiodes.angle_error_deg = draws.of("photodiodes.angle_error_deg").within(-5.0, 5.0);
    c.photodiodes.noise = draws.of("photodiodes.noise").one_of(std::array{0.003, 0.01, 0.03});
    c.photodiodes.jitter_s =
        draws.of("photodiodes.jitter_s, which").is_one_in(2) ? 0.0 : draws.of("photodiodes.jitter_s").within(0.0, 1e-6);
}

// One kind of fault after the other from scenario to scenario, and then all of them at once.
std::string draw_faults(const Draws& draws, std::int64_t k, config::Config& c) {
    constexpr std::size_t n_kinds = twin::n_fault_kinds;
    const auto choice = static_cast<std::size_t>(k) % (n_kinds + 2);
    if (choice == n_kinds) return "no fault";
    c.faults.random_seed = draws.of("faults.random_seed").below(1'000'000'000);
    c.faults.random_per_hour = 600.0;
    if (choice > n_kinds) return "faults of all kinds";
    c.faults.random_kinds = {twin::all_fault_kinds[choice]};
    return std::string{twin::fault_kind_names[choice]};
}

}  // namespace

Scenario scenario(std::uint64_t seed, std::int64_t k, double duration_s) {
    const Draws draws{.seed = seed, .cause = chance::Cause::scenario, .trial = static_cast<std::uint64_t>(k)};
    config::Config c;
    c.run.duration_s = duration_s;
    draw_gyro(draws, c);
    draw_switching(draws, c);
    draw_compensation(draws, c);
    draw_motion(draws, c);
    const std::string faults = draw_faults(draws, k, c);
    draw_readout(draws, c);
    if (c.gyro.fidelity == config::Fidelity::laser) c = rig::calibrated_by_laser(c);
    config::check(c);
    return {fmt::format("{}: {}, relock {}, bridge {}", k, faults, static_cast<int>(*c.compensation.relock),
                        static_cast<int>(c.compensation.bridge)),
            std::move(c)};
}

}  // namespace zlg::trials
