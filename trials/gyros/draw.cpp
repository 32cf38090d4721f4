// What a gyro of this kind can be: narrower than the ranges of the keys, in which only the arithmetic has a meaning.

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <zlg/chance/draw.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/resolved.hpp>
#include <zlg/trials/gyro_campaign.hpp>

namespace zlg::trials {
namespace {

enum class Law : unsigned char { even, logarithmic, either_sign, whole };

struct Range {
    std::string_view key;
    Law law;  // even in the number, in its logarithm, in that with either sign; whole numbers
    double least;
    double most;
};

constexpr Range of_any_gyro[] = {
    {"gyro.tick_s", Law::logarithmic, 0.002, 0.01},                    // coils are reversed at 100 to 500 Hz
    {"gyro.reference_temperature_c", Law::even, -40, 60},              // where it is switched on
    {"gyro.temperature_rise_c", Law::even, -20, 40},                   // its own heat, and a chamber that cools
    {"gyro.bias_temperature_coefficient_per_c", Law::even, -1e-3, 0},  // -5e-4 is a fair guess (docs/physics.md)
    {"gyro.light_samples", Law::whole, 8, 64},
    {"gyro.light_noise_lambda", Law::logarithmic, 5e-4, 0.01},
    {"drift.magnetic_arcsec_s", Law::either_sign, 0.01, 10},  // well shielded, not shielded
    {"drift.magnetic_thermal_arcsec_s", Law::either_sign, 0.01, 5},
    {"drift.thermal_time_s", Law::logarithmic, 600, 6000},  // of a block of glass of a few hundred grams
    {"drift.nonmagnetic_arcsec_s", Law::either_sign, 0.01, 0.5},
    {"perimeter.limit_lambda", Law::even, 0.05, 0.15},
    {"perimeter.expansion_lambda_per_c", Law::even, 0.005, 0.04},  // of 16 cm: 0.2e-7 to 1.6e-7 per degree
    {"piezo.half_wave_v", Law::even, 20, 80},
    {"piezo.half_wave_temperature_coefficient_per_c", Law::even, -0.001, 0.005},  // ceramics grow stronger when warm
    {"piezo.half_wave_error", Law::even, -0.05, 0.05},                            // as the workshop knows it
    {"piezo.rc_s", Law::logarithmic, 2e-4, 1.5e-3},
};

// Two gyros of three have what an ideal piezo has not.
constexpr Range of_a_real_piezo[] = {
    {"piezo.hysteresis", Law::even, 0.08, 0.18},  // usual; docs/physics.md, as the next two
    {"piezo.creep_per_decade", Law::even, 0.01, 0.03},
    {"piezo.mirror_hz", Law::logarithmic, 3e3, 15e3},
};

// What a laser makes of itself, the averaged gyro is given.
constexpr Range of_averaged[] = {
    {"gyro.bias_chi", Law::even, 2, 7},
    {"gyro.discriminator_per_lambda", Law::either_sign, 0.15, 0.7},  // over gain and field
    {"drift.random_walk_arcsec_sqrt_s", Law::logarithmic, 0.02, 0.3},
};

constexpr Range of_laser[] = {
    {"laser.perimeter_m", Law::even, 0.1, 0.2},
    {"laser.round_trip_loss_ratio", Law::logarithmic, 0.003, 0.01},
    {"laser.gain_loss_ratio", Law::even, 1.1, 1.3},
    {"laser.doppler_half_width_hz", Law::even, 880e6, 930e6},            // neon at 375 to 420 K
    {"laser.homogeneous_half_width_hz", Law::logarithmic, 80e6, 200e6},  // by pressure
    {"laser.isotope_shift_hz", Law::even, 875e6, 1000e6},                // sources differ
    {"laser.upper_isotope_ratio", Law::even, 0.465, 0.535},
    {"laser.zeeman_hz_per_g", Law::even, 1.8e6, 1.84e6},
    {"laser.opposite_sigma_coupling", Law::even, 0.4, 0.8},
    {"laser.bias_field_g", Law::even, 10, 18},  // from about 20 G on the middle between the modes runs one way
    {"laser.lock_in_left_hz", Law::logarithmic, 50, 500},
    {"laser.lock_in_right_hz", Law::logarithmic, 50, 500},
};

constexpr Range of_photodiodes[] = {
    {"photodiodes.offset_cosine", Law::even, -0.05, 0.05},   {"photodiodes.offset_sine", Law::even, -0.05, 0.05},
    {"photodiodes.amplitude_error", Law::even, -0.05, 0.05}, {"photodiodes.angle_error_deg", Law::even, -5, 5},
    {"photodiodes.noise", Law::logarithmic, 0.003, 0.02},    {"photodiodes.adc_bits", Law::whole, 10, 14},
};

// Two photodiodes of one batch or of two, their dark light, and a tube that fades within hours.
constexpr Range of_light[] = {
    {"light.gain_b", Law::logarithmic, 0.7, 1.4}, {"light.gain_drift_per_h", Law::even, -0.05, 0.05},
    {"light.offset_a", Law::even, -0.01, 0.01},   {"light.offset_b", Law::even, -0.01, 0.01},
    {"light.power_decay_per_h", Law::even, 0, 1},
};

constexpr double longest_gap_ticks = 16.0;  // of the core

class Drawing {
public:
    Drawing(const chance::Draws& draws, config::Fidelity fidelity)
        : draws_{draws}, is_laser_{fidelity == config::Fidelity::laser} {}

    config::Settings all() {
        set_run();
        set_gyro();
        set_piezo();
        set_perimeter();
        set_motion();
        set_switching();
        set_compensation();
        set_lock_in();
        return std::move(settings_);
    }

private:
    // Four digits, as a person would write it: the gyro is the one that the command names.
    void set(std::string_view key, double value) { set(key, fmt::format("{:.4g}", value)); }
    void set(std::string_view key, const std::string& text) {
        config::apply_pair(c_, key, text, "a random gyro");
        settings_.emplace_back(key, text);
    }

    void set(const Range& r) {
        chance::Draw draw = draws_.of(r.key);
        switch (r.law) {
            case Law::even: return set(r.key, draw.within(r.least, r.most));
            case Law::logarithmic: return set(r.key, draw.within_log(r.least, r.most));
            case Law::either_sign: {
                const double sign = draw.sign();
                return set(r.key, sign * draw.within_log(r.least, r.most));
            }
            case Law::whole:
                return set(r.key,
                           r.least + static_cast<double>(draw.below(static_cast<std::size_t>(r.most - r.least) + 1)));
        }
    }
    void set_even(std::string_view key, double least, double most) { set({key, Law::even, least, most}); }
    void set_log(std::string_view key, double least, double most) { set({key, Law::logarithmic, least, most}); }
    // The whole numbers from the least on, so many of them.
    void set_whole(std::string_view key, double least, std::size_t n) {
        set(key, least + static_cast<double>(draws_.of(key).below(n)));
    }
    // A choice that is no key of its own, named by what depends on it.
    [[nodiscard]] bool is_one_in(std::size_t n, std::string_view choice) const {
        return draws_.of(choice).is_one_in(n);
    }
    template <std::size_t n> void set(const Range (&ranges)[n]) {
        for (const Range& r : ranges) set(r);
    }

    // A name that stands there twice is drawn twice as often.
    template <std::size_t n> void set_one_of(std::string_view key, const std::array<const char*, n>& names) {
        set(key, std::string{draws_.of(key).one_of(names)});
    }

    void set_run() {
        set("run.seed", fmt::format("{}", draws_.of("run.seed").below(1'000'000'000)));
        set_log("run.duration_s", 60.0, 600.0);
        set("gyro.fidelity", std::string{is_laser_ ? "laser" : "averaged"});
    }

    void set_gyro() {
        set(of_any_gyro);
        set(of_light);
        set_log("gyro.bias_edge_s", 0.005 * c_.gyro.tick_s, 0.04 * c_.gyro.tick_s);  // coil and driver
        set("gyro.first_bias_sign", draws_.of("gyro.first_bias_sign").sign());
        set_one_of("gyro.readout", std::array{"count", "count", "phase"});
        if (c_.gyro.readout == config::Readout::phase) set(of_photodiodes);
        const bool is_x4 = is_one_in(3, "counter of all edges");
        if (is_laser_) {
            set(of_laser);
            set("laser.quadrature", std::string{is_x4 ? "x4" : "x1"});
            set_one_of("gyro.dither", std::array{"auto", "auto", "random", "paired", "none"});
            keep_light_off_the_reversals();
            return;
        }
        set(of_averaged);
        // 4 lambda/L of square rings of 10 to 28 cm; a counter of all four edges has a quarter, and four times the
        // bias.
        const double counts = is_x4 ? 4.0 : 1.0;
        set("gyro.scale_arcsec", 3.263 * 0.16 / draws_.of("gyro.scale_arcsec").within(0.1, 0.28) / counts);
        set_log("gyro.bias_hz", counts * 30e3, counts * 120e3);
    }

    // The light is not sampled while the field is reversed, sooner or later by up to a cycle of the bias.
    void keep_light_off_the_reversals() {
        const config::Laser& l = c_.laser;
        const config::Laser usual;
        constexpr double usual_bias_hz = 60e3;
        const double bias_hz = usual_bias_hz * (l.round_trip_loss_ratio / usual.round_trip_loss_ratio) *
                               (l.gain_loss_ratio / usual.gain_loss_ratio) * (l.bias_field_g / usual.bias_field_g) *
                               (usual.perimeter_m / l.perimeter_m);
        const double cycle_s = c_.gyro.dither == core::DitherMethod::none ? 0.0 : 1.2 / bias_hz;
        const double most = 0.25 * c_.gyro.tick_s / (0.5 * c_.gyro.bias_edge_s + cycle_s);
        if (c_.gyro.light_samples > most) set("gyro.light_samples", std::max(8.0, std::floor(most)));
    }

    void set_piezo() {
        const double move_s =
            draws_.of("piezo.slew_v_s").within_log(2e-3, 12e-3);  // published: a few milliseconds for a half-wave
        set("piezo.slew_v_s", c_.piezo.half_wave_v / move_s);
        // A switch and the warming must find room: three to eight half-waves, from zero or of either sign.
        const double range_v = c_.piezo.half_wave_v * draws_.of("piezo.range_max_v").within(3.0, 8.0);
        const double below = is_one_in(2, "range of either sign") ? 0.5 : 0.0;
        set("piezo.range_min_v", -below * range_v);
        set("piezo.range_max_v", (1.0 - below) * range_v);
        set_one_of("perimeter.loop", std::array{"analog", "analog", "digital", "digital", "exponential"});
        // The loop of a formula has no use for a real piezo, and refuses it.
        if (c_.perimeter.loop == config::Loop::exponential || is_one_in(3, "ideal piezo")) return;
        set(of_a_real_piezo);
        set("piezo.hysteresis_stroke_v", range_v);
    }

    void set_perimeter() {
        set_log("perimeter.tau_s", std::max(0.003, 0.5 * c_.gyro.tick_s), 0.02);
        set_whole("perimeter.relock_halves", 0.0, 9);
        // What comes of itself, for half of them; else where the light runs both ways: of lasers of 10 cm or of little
        // gain it does not from 0.15 wavelength on, so that no switch with such a miss succeeds.
        if (is_one_in(2, "miss of itself"))
            set("perimeter.miss_lambda", 0.0);
        else
            set_even("perimeter.miss_lambda", 0.02, is_laser_ ? 0.12 : 0.2);
    }

    // Of a vehicle or a turntable: up to 28 deg/s for ever, 8 deg/s there and back.
    void set_motion() {
        set_one_of("motion.kind", std::array{"rest", "constant", "sine", "sine", "sum"});
        const config::MotionKind kind = c_.motion.kind;
        if (kind == config::MotionKind::rest) return;
        if (kind == config::MotionKind::constant || is_one_in(2, "rate beside the tones"))
            set({"motion.rate_arcsec_s", Law::either_sign, 1.0, 1e5});
        if (kind == config::MotionKind::constant) return;
        const std::size_t n = kind == config::MotionKind::sine ? 1 : 2 + draws_.of("number of tones").below(3);
        chance::Draw amplitude = draws_.of("motion.amplitude_arcsec_s");
        chance::Draw frequency = draws_.of("motion.frequency_hz");
        chance::Draw phase = draws_.of("motion.phase_deg");
        std::vector<std::string> amplitudes, frequencies, phases;
        for (std::size_t i = 0; i < n; ++i) {
            amplitudes.push_back(fmt::format("{:.4g}", amplitude.within_log(10.0, 3e4)));
            frequencies.push_back(fmt::format("{:.4g}", frequency.within_log(0.02, 25.0)));
            phases.push_back(fmt::format("{:.4g}", phase.within(0.0, 360.0)));
        }
        set("motion.amplitude_arcsec_s", fmt::format("[{}]", fmt::join(amplitudes, ",")));
        set("motion.frequency_hz", fmt::format("[{}]", fmt::join(frequencies, ",")));
        set("motion.phase_deg", fmt::format("[{}]", fmt::join(phases, ",")));
    }

    // The time after which nothing of a miss is left for the correction of a re-lock to find.
    [[nodiscard]] double settling_s() const {
        const config::Perimeter& p = c_.perimeter;
        const double limited_s = std::max(p.miss_lambda, 0.1) / p.limit_lambda * p.tau_s;
        if (p.loop == config::Loop::digital && p.relock_halves > 0) return limited_s + 5.0 * p.settled_tau_s;
        return limited_s + 8.0 * p.tau_s;
    }

    void set_switching() {
        const double tick_s = c_.gyro.tick_s;
        // The stage must have arrived: hysteresis and U_lambda/2 make the move longer by a fifth.
        const double move_s = 1.2 * c_.piezo.half_wave_v / c_.piezo.slew_v_s + 4.0 * c_.piezo.rc_s;
        const double gap_ticks =
            std::ceil(move_s / tick_s) + static_cast<double>(draws_.of("switching.gap_ticks").below(3));
        set("switching.gap_ticks", std::clamp(gap_ticks, 2.0, longest_gap_ticks));
        if (is_one_in(2, "short gap")) set_whole("switching.gap_min_ticks", 1.0, 2);
        set("compensation.relock_ticks",
            std::clamp(std::ceil(settling_s() / tick_s) +
                           static_cast<double>(draws_.of("compensation.relock_ticks").below(10)),
                       10.0, 64.0));
        // Several re-locks long, and eight of them in the run.
        const double cycle_s = (c_.switching.gap_ticks + c_.compensation.relock_ticks) * tick_s;
        const double least_s = std::max(2.0, 5.0 * cycle_s);
        const double most_s = std::max(1.01 * least_s, *c_.run.duration_s / 8.0);
        set_log("switching.interval_s", least_s, most_s);
        if (is_one_in(12, "optimal interval")) set("switching.interval_s", std::string{"optimal"});
        set_one_of("switching.first_segment", std::array{"full", "half"});
        set_one_of("switching.schedule", std::array{"fixed", "measured"});
        set_even("switching.interval_min_s", least_s, most_s);
        set_even("switching.interval_max_s", most_s, 2.0 * most_s);
    }

    void set_compensation() {
        set_one_of("compensation.relock", std::array{"mean_square", "mean_square", "joint", "joint"});
        // Both take the decay for exponential.
        if (c_.perimeter.loop != config::Loop::digital && is_one_in(3, "exponential re-lock"))
            set_one_of("compensation.relock", std::array{"detuning", "frequency"});
        // The sigma of a polynomial holds no motion beyond its order (docs/compensation.md).
        const bool is_even =
            c_.motion.kind == config::MotionKind::rest || c_.motion.kind == config::MotionKind::constant;
        if (is_even && is_one_in(2, "polynomial bridge"))
            set_one_of("compensation.bridge", std::array{"quadratic", "linear", "constant"});
        else
            set("compensation.bridge", std::string{"auto"});
        set_whole("compensation.points_before", 2.0, 4);
        set_whole("compensation.points_after", 2.0, 4);
        set_whole("compensation.extrapolation_points", 3.0, 4);
        set_one_of("compensation.magnetic", std::array{"none", "none", "watch", "estimate"});
        if (c_.compensation.magnetic != core::MagneticMethod::none && is_one_in(2, "calibrated drift"))
            set_calibrated_drift();
    }

    // A calibration that errs by its own sigma.
    void set_calibrated_drift() {
        const auto set_known = [&](const char* key, const char* sigma_key, double truth) {
            const double sigma = draws_.of(sigma_key).within_log(0.01, 1.0);
            set(key, truth + sigma * draws_.of(key).normal());
            set(sigma_key, sigma);
        };
        set_known("compensation.magnetic_arcsec_s", "compensation.magnetic_sigma_arcsec_s", c_.drift.magnetic_arcsec_s);
        set_known("compensation.magnetic_thermal_arcsec_s", "compensation.magnetic_thermal_sigma_arcsec_s",
                  c_.drift.magnetic_thermal_arcsec_s);
        set("compensation.magnetic_thermal_time_s",
            c_.drift.thermal_time_s * draws_.of("compensation.magnetic_thermal_time_s").within(0.8, 1.25));
    }

    // Not calibrated, or by both modes together, of which either is off by half of their difference. The averaged gyro
    // does not lock.
    void set_lock_in() {
        const double left_hz = c_.laser.lock_in_left_hz, right_hz = c_.laser.lock_in_right_hz;
        const bool is_calibrated = is_laser_ && is_one_in(2, "calibrated lock-in");
        const double mean_hz = 0.5 * (left_hz + right_hz);
        const double sigma_hz = core::maths::hypot(0.5 * (left_hz - right_hz), 0.03 * mean_hz);
        set("compensation.lock_in_hz", is_calibrated ? mean_hz : 0.0);
        set("compensation.lock_in_sigma_hz", is_calibrated ? sigma_hz : c_.compensation.lock_in_sigma_hz);
    }

    chance::Draws draws_;
    bool is_laser_;
    config::Config c_;  // as far as it is drawn
    config::Settings settings_;
};

// What the program does before it runs a gyro.
config::Config accepted(const config::Settings& settings) {
    config::Config made;
    for (const auto& [key, text] : settings) config::apply_pair(made, key, text, "a random gyro");
    config::check(made);
    made = study::resolved(made).config;
    const twin::Motion motion = rig::motion(made);
    static_cast<void>(rig::run_ticks(made, motion));
    static_cast<void>(rig::ClosedLoop{made, motion});
    static_cast<void>(rig::asked_compensation(made));
    return made;
}

}  // namespace

GyroTrial random_gyro(std::uint64_t seed, std::uint64_t number, config::Fidelity fidelity) {
    constexpr std::size_t patience = 100;
    GyroTrial trial{.number = number};
    for (;;) {
        const chance::Draws draws{
            .seed = seed, .cause = chance::Cause::random_gyro, .trial = number * (patience + 1) + trial.refused.size()};
        trial.settings = Drawing{draws, fidelity}.all();
        try {
            trial.config = accepted(trial.settings);
            return trial;
        } catch (const config::ConfigError& error) {
            if (trial.refused.size() == patience) throw;
            trial.refused.emplace_back(error.what());
        }
    }
}

std::string command(const GyroTrial& trial) {
    std::string line = "zlg run";
    for (const auto& [key, text] : trial.settings) line += fmt::format(" --set {}={}", key, text);
    return line;
}

}  // namespace zlg::trials
