#include "gyro.hpp"

#include <cmath>

#include <zlg/core/common/maths.hpp>

namespace zlg::trials {
namespace {

// Light is made for the halves that a re-lock estimator may use (16 of core::profile_halves, 40 of relock_ticks), with
// some reserve.
constexpr std::int64_t lit_halves = 64;

// After closing, until the beat is taken as steady.
constexpr std::int64_t settling_halves = 16;

const std::vector<double>& constant_ratios() {
    static const std::vector<double> ones(core::max_light_samples, 1.0);
    return ones;
}

}  // namespace

SyntheticGyro::SyntheticGyro(const GyroLaw& law, const MotionLaw& motion, std::uint64_t seed)
    : law_{law},
      motion_{motion, 0.5 * law.tick_s, {seed, chance::Cause::synthetic_motion}},
      draw_{seed, chance::Cause::synthetic_gyro},
      decay_{relock_decay(law.loop, law.light_samples)},
      first_sign_{static_cast<std::int8_t>(draw_.sign())},
      since_closing_{static_cast<std::int64_t>(decay_.size())},
      phase_counts_{draw_.uniform()},
      fringe_{law.photodiodes, phase_counts_} {
    if (law.photodiodes.reads && law.photodiodes.learnt) fringe_.learn(draw_);
}

void SyntheticGyro::open() {
    gap_left_ = 2 * law_.gap_ticks;
    mode_ = static_cast<std::int8_t>(-mode_);
    miss_lambda_ = law_.miss_lambda * draw_.sign();
    since_closing_ = 0;
}

double SyntheticGyro::magnetic_arcsec_s() const {
    if (law_.magnetic_arcsec_s == 0.0 && law_.magnetic_thermal_arcsec_s == 0.0) return 0.0;
    const double t = 0.5 * law_.tick_s * static_cast<double>(half_);
    return law_.magnetic_arcsec_s - law_.magnetic_thermal_arcsec_s * core::maths::expm1(-t / law_.thermal_time_s);
}

SyntheticHalf SyntheticGyro::advance(double more_arcsec) {
    SyntheticHalf half;
    half.record.half = half_;
    half.record.bias_sign = half_ % 2 == 0 ? first_sign_ : static_cast<std::int8_t>(-first_sign_);
    half.record.mode = mode_;
    half.record.temperature_c = 20.0;
    half.record.piezo_v = mode_ > 0 ? 140.0 : 180.0;
    half.true_arcsec = motion_.advance() + more_arcsec;
    if (law_.random_walk_arcsec_sqrt_s > 0.0)
        half.walk_arcsec = law_.random_walk_arcsec_sqrt_s * std::sqrt(0.5 * law_.tick_s) * draw_.normal();
    half.record.loop_closed = gap_left_ == 0;
    if (gap_left_ > law_.lit_halves)
        in_gap(half);
    else
        measure(half);
    if (gap_left_ > 0) --gap_left_;
    half.rounding_arcsec = law_.scale_arcsec * (fringe_.reading_counts() - phase_counts_);
    ++half_;
    return half;
}

void SyntheticGyro::in_gap(SyntheticHalf& half) {
    half.record.counts = static_cast<std::int64_t>(2000.0 * (draw_.uniform() - 0.5));
    half.record.detuning_lambda = 0.5 * (draw_.uniform() - 0.5);
    half.record.detuning_sq_lambda2 = 0.1 * draw_.uniform();
    phase_counts_ = 1e4 * draw_.uniform();
    fringe_.lose(phase_counts_, draw_);
    // The light is back before the loop closes: the place within the count is read at the end of the gap.
    if (gap_left_ == 1)
        half.record.fringe = fringe_.read(phase_counts_, half.record.bias_sign * mode_, false, draw_).fringe;
}

void SyntheticGyro::measure(SyntheticHalf& half) {
    const double half_s = 0.5 * law_.tick_s;
    const double sign = half.record.bias_sign * mode_;
    const bool open = !half.record.loop_closed;
    const auto k = static_cast<std::size_t>(since_closing_);
    const bool settled = k >= decay_.size();
    const double mean_sq_ratio = open ? 1.0 : settled ? 0.0 : decay_[k].mean_sq;
    const double deficit_hz =
        law_.chi * (1.0 + law_.chi_error_ratio) * law_.bias_hz * law_.miss_lambda * law_.miss_lambda * mean_sq_ratio;
    half.magnetic_arcsec = open ? 0.0 : mode_ * magnetic_arcsec_s() * half_s;
    phase_counts_ += (half.true_arcsec + half.walk_arcsec + half.magnetic_arcsec) / law_.scale_arcsec +
                     sign * (law_.bias_hz - deficit_hz) * half_s;
    read_count(half, !open && since_closing_ >= settling_halves);
    half.false_arcsec = -sign * deficit_hz * half_s * law_.scale_arcsec;
    if (open)
        sample_light(half, constant_ratios());
    else if (since_closing_ < lit_halves)
        sample_light(half, decay_[k].samples);
    else
        half.record.detuning_sq_lambda2 = law_.light_noise_lambda * law_.light_noise_lambda;
    half.record.lit = true;
    if (!open && !settled) ++since_closing_;
}

void SyntheticGyro::read_count(SyntheticHalf& half, bool settled) {
    const FringeReading read = fringe_.read(phase_counts_, half.record.bias_sign * mode_, settled, draw_);
    half.record.counts = read.counts;
    half.record.fringe = read.fringe;
}

void SyntheticGyro::sample_light(SyntheticHalf& half, const std::vector<double>& ratios) {
    const double slope = synthetic_discriminator_per_lambda * half.record.bias_sign * mode_;
    const auto n = static_cast<std::size_t>(law_.light_samples);
    double sum = 0.0;
    double sum_sq = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
        const double dl = miss_lambda_ * ratios[j] + law_.light_noise_lambda * draw_.normal();
        light_a_[j] = static_cast<float>(1000.0 * (1.0 + slope * dl));
        light_b_[j] = static_cast<float>(1000.0 * (1.0 - slope * dl));
        sum += dl;
        sum_sq += dl * dl;
    }
    half.record.detuning_lambda = sum / static_cast<double>(n);
    half.record.detuning_sq_lambda2 = sum_sq / static_cast<double>(n);
    half.light = {.a = {light_a_.data(), n}, .b = {light_b_.data(), n}};
}

}  // namespace zlg::trials
