#pragma once
// Records of a gyro that is nothing but the laws to be found, made without the twin.

#include <zlg/calibration/lab_reader.hpp>
#include <zlg/numeric/estimate.hpp>

#include "test.hpp"

namespace synthetic {

using zlg::core::HalfRecord;

struct SyntheticGyro {
    double tick_s = 0.005;
    double scale_arcsec = 3.263;
    double bias_hz = 60'123.4;
    double bias_per_c = 0.0;
    double start_c = 20.0;
    double rise_c = 0.0;  // at an even pace over the log
    double chi = 4.0;
    std::vector<double> chi_higher = {};  // loss by dl^4, dl^6, ...
    double miss_lambda = 0.2;
    double tau_s = 0.012;
    bool stepped = false;         // the detuning goes from border to border with a lag of 0.8 ms
    double detuning_scale = 1.0;  // logged over true
    double pole_lambda = 0.0;     // logged is this times the tangent of the true over it; 0: proportional
    int light_samples = 16;
    double light_noise_lambda = 0.003;
    double half_wave_v = 40.0;
    double half_wave_per_c = 0.0;
    int half_waves = 1;      // between the two modes
    double quantum_v = 0.0;  // of the reading
    double noise_v = 0.02;
    double magnetic_arcsec_s = 0.0;
    double thermal_arcsec_s = 0.0;
    double thermal_s = 100.0;
    double rate_arcsec_s = 5.0;
    double walk_arcsec_sqrt_s = 0.0;
    double sway_arcsec_s = 0.0;
    double sway_hz = 1.0;
    int first_sign = 1;
    int segment_ticks = 400;
    int gap_ticks = 3;
    int mode_changes = 1;  // 0: the same mode after every gap
    std::uint64_t seed = 1;
    bool with_phase = false;  // the places within the count are read
    double lock_hz = 0.0;     // of a gyro whose field turns round in no time

    [[nodiscard]] double temperature_c(double t_s, double duration_s) const {
        return start_c + rise_c * t_s / duration_s;
    }
};

class Synthesis {
public:
    Synthesis(const SyntheticGyro& gyro, double duration_s) : g_{gyro}, duration_s_{duration_s}, random_{gyro.seed} {}

    HalfRecord next() {
        const int tick = half_ / 2;
        const int in_segment = tick % g_.segment_ticks;
        const bool gap = tick >= g_.segment_ticks && in_segment < g_.gap_ticks;
        if (gap && in_segment == 0 && half_ % 2 == 0) mode_ = g_.mode_changes != 0 ? -mode_ : mode_;
        const double t_s = 0.5 * g_.tick_s * half_;
        HalfRecord r;
        r.half = half_;
        r.bias_sign = static_cast<std::int8_t>(half_ % 2 == 0 ? g_.first_sign : -g_.first_sign);
        r.mode = static_cast<std::int8_t>(mode_);
        r.loop_closed = !gap;
        r.temperature_c = g_.temperature_c(t_s + 0.5 * g_.tick_s, duration_s_);
        const bool relocked = tick >= g_.segment_ticks;
        const double since_s = (in_segment - g_.gap_ticks) * g_.tick_s + 0.5 * g_.tick_s * (half_ % 2);
        light(gap || !relocked ? 0.0 : g_.miss_lambda, since_s, r);
        count(gap, t_s, r);
        ++half_;
        return r;
    }

private:
    double normal() { return normal_(random_); }

    [[nodiscard]] double detuning(double miss, double since_s, double within_s) const {
        if (!g_.stepped) return miss * std::exp(-(since_s + within_s) / g_.tau_s);
        const double from = miss * std::exp(-since_s / g_.tau_s);
        const double to = miss * std::exp(-(since_s + 0.5 * g_.tick_s) / g_.tau_s);
        // Uneven steps, as a loop makes that corrects by halves of its own noise.
        return to + (from - to) * std::exp(-within_s / 0.0008);
    }

    [[nodiscard]] double logged(double dl) const {
        return g_.pole_lambda > 0.0 ? g_.pole_lambda * std::tan(dl / g_.pole_lambda) : dl;
    }

    void light(double miss, double since_s, HalfRecord& r) {
        const double half_s = 0.5 * g_.tick_s;
        true_square_ = true_higher_ = 0.0;
        for (int k = 0; k < fine; ++k) {
            const double dl = detuning(miss, since_s, half_s * (k + 0.5) / fine);
            true_square_ += dl * dl / fine;
            for (std::size_t j = 0; j < g_.chi_higher.size(); ++j)
                true_higher_ += g_.chi_higher[j] * std::pow(dl * dl, j + 2) / fine;
        }
        for (int k = 0; k < g_.light_samples; ++k) {
            const double dl = detuning(miss, since_s, half_s * (k + 0.5) / g_.light_samples);
            const double sample = g_.detuning_scale * (logged(dl) + g_.light_noise_lambda * normal());
            r.detuning_lambda += sample / g_.light_samples;
            r.detuning_sq_lambda2 += sample * sample / g_.light_samples;
        }
        const double above_c = r.temperature_c - g_.start_c;
        const double half_wave_v = g_.half_wave_v * (1.0 + g_.half_wave_per_c * above_c);
        const double end = detuning(miss, since_s, half_s * (1.0 - 1e-12));
        double v = 100.0 + (mode_ > 0 ? 0.0 : half_wave_v * g_.half_waves) + 2.0 * half_wave_v * end;
        v += g_.noise_v * normal();
        r.piezo_v = g_.quantum_v > 0.0 ? g_.quantum_v * std::round(v / g_.quantum_v) : v;
    }

    // Mid-half values of the slow laws; the bias and its loss exactly.
    void count(bool gap, double t_s, HalfRecord& r) {
        const double half_s = 0.5 * g_.tick_s;
        const double middle_s = t_s + 0.5 * half_s;
        const double f = g_.bias_hz * (1.0 + g_.bias_per_c * (g_.temperature_c(middle_s, duration_s_) - g_.start_c));
        const double magnetic = g_.magnetic_arcsec_s + g_.thermal_arcsec_s * -std::expm1(-middle_s / g_.thermal_s);
        const double sway = g_.sway_arcsec_s * std::sin(2.0 * 3.14159265358979 * g_.sway_hz * middle_s);
        const double angle = (g_.rate_arcsec_s + mode_ * magnetic + sway) * half_s +
                             g_.walk_arcsec_sqrt_s * std::sqrt(half_s) * normal();
        double cycles =
            r.bias_sign * mode_ * f * (1.0 - g_.chi * true_square_ - true_higher_) * half_s + angle / g_.scale_arcsec;
        // Adler's mean beat.
        const double locked = g_.lock_hz * half_s;
        cycles = std::copysign(std::sqrt(std::fmax(cycles * cycles - locked * locked, 0.0)), cycles);
        if (gap) cycles += 10.0 * normal();
        const double before = std::floor(phase_);
        phase_ += cycles;
        r.counts = static_cast<std::int64_t>(std::floor(phase_) - before);
        if (g_.with_phase) r.fringe = static_cast<float>(std::floor(65536.0 * (phase_ - std::floor(phase_))));
        // Small phases lose no digits.
        phase_ -= before;
    }

    static constexpr int fine = 64;
    SyntheticGyro g_;
    double duration_s_;
    std::mt19937_64 random_;
    std::normal_distribution<double> normal_;
    int half_ = 0;
    int mode_ = 1;
    double phase_ = 0.3;
    double true_square_ = 0.0;
    double true_higher_ = 0.0;
};

// `without` puts out columns before they are seen.
template <class Without>
zlg::calibration::LabLog log_of(const SyntheticGyro& gyro, double duration_s, Without without) {
    Synthesis synthesis{gyro, duration_s};
    zlg::calibration::LabReader reader{"synthetic", gyro.tick_s};
    const auto halves = static_cast<int>(std::lround(2.0 * duration_s / gyro.tick_s));
    for (int h = 0; h < halves; ++h) {
        HalfRecord r = synthesis.next();
        without(r);
        reader.take(r);
    }
    return reader.finish();
}

inline zlg::calibration::LabLog log_of(const SyntheticGyro& gyro, double duration_s) {
    return log_of(gyro, duration_s, [](HalfRecord&) {});
}

inline std::vector<zlg::calibration::LabLog> one_log(const SyntheticGyro& gyro, double duration_s) {
    return {log_of(gyro, duration_s)};
}

// How far an estimate is off, in its own standard errors.
inline double errors_off(const zlg::numeric::Estimate& e, double truth) { return (e.value - truth) / e.sigma; }

}  // namespace synthetic
