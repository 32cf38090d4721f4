#include "accuracy_gyro.hpp"

#include <cmath>

namespace zlg::trials {
namespace {

// Light is made for the halves that a re-lock estimator may look at, and for some more.
constexpr std::int64_t lit_halves = 64;

}  // namespace

SyntheticGyro::SyntheticGyro(const GyroLaw& law, const MotionLaw& motion, std::uint64_t seed)
    : law_{law},
      motion_{motion, 0.5 * law.tick_s, 2 * seed},
      draw_{2 * seed + 1},
      course_{loop_course(law.loop, law.light_samples)},
      first_sign_{static_cast<std::int8_t>(draw_.sign())},
      since_closing_{static_cast<std::int64_t>(course_.size())},
      phase_counts_{draw_.uniform()} {}

void SyntheticGyro::open() {
    blind_left_ = 2 * law_.gap_ticks;
    mode_ = static_cast<std::int8_t>(-mode_);
    miss_lambda_ = law_.miss_lambda * draw_.sign();
    since_closing_ = 0;
}

double SyntheticGyro::magnetic_arcsec_s() const {
    if (law_.magnetic_arcsec_s == 0.0 && law_.magnetic_thermal_arcsec_s == 0.0) return 0.0;
    const double t = 0.5 * law_.tick_s * static_cast<double>(half_);
    return law_.magnetic_arcsec_s - law_.magnetic_thermal_arcsec_s * std::expm1(-t / law_.thermal_time_s);
}

SyntheticHalf SyntheticGyro::advance() {
    SyntheticHalf half;
    half.record.half = half_;
    half.record.bias_sign = half_ % 2 == 0 ? first_sign_ : static_cast<std::int8_t>(-first_sign_);
    half.record.mode = mode_;
    half.record.temperature_c = 20.0;
    half.record.piezo_v = mode_ > 0 ? 140.0 : 180.0;
    half.true_arcsec = motion_.advance();
    if (blind_left_ > 0)
        blind(half);
    else
        watch(half);
    half.rounding_arcsec = law_.scale_arcsec * (std::floor(phase_counts_) - phase_counts_);
    ++half_;
    return half;
}

void SyntheticGyro::blind(SyntheticHalf& half) {
    --blind_left_;
    half.record.loop_closed = false;
    half.record.counts = static_cast<std::int64_t>(2000.0 * (draw_.uniform() - 0.5));
    half.record.detuning_lambda = 0.5 * (draw_.uniform() - 0.5);
    half.record.detuning_sq_lambda2 = 0.1 * draw_.uniform();
    phase_counts_ = 1e4 * draw_.uniform();
}

void SyntheticGyro::watch(SyntheticHalf& half) {
    const double half_s = 0.5 * law_.tick_s;
    const double sign = half.record.bias_sign * mode_;
    const bool settled = since_closing_ >= static_cast<std::int64_t>(course_.size());
    const double mean_sq =
        settled ? 0.0 : law_.miss_lambda * law_.miss_lambda * course_[static_cast<std::size_t>(since_closing_)].mean_sq;
    const double deficit_hz = law_.chi * (1.0 + law_.chi_error_ratio) * law_.bias_hz * mean_sq;
    const double before = std::floor(phase_counts_);
    half.magnetic_arcsec = mode_ * magnetic_arcsec_s() * half_s;
    phase_counts_ +=
        (half.true_arcsec + half.magnetic_arcsec) / law_.scale_arcsec + sign * (law_.bias_hz - deficit_hz) * half_s;
    half.record.counts = static_cast<std::int64_t>(std::floor(phase_counts_) - before);
    half.false_arcsec = -sign * deficit_hz * half_s * law_.scale_arcsec;
    if (since_closing_ < lit_halves)
        shine(half, static_cast<std::size_t>(since_closing_));
    else
        half.record.detuning_sq_lambda2 = law_.light_noise_lambda * law_.light_noise_lambda;
    if (!settled) ++since_closing_;
}

void SyntheticGyro::shine(SyntheticHalf& half, std::size_t k) {
    const double slope = synthetic_discriminator_per_lambda * half.record.bias_sign * mode_;
    const auto n = static_cast<std::size_t>(law_.light_samples);
    double sum = 0.0;
    double sum_sq = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
        const double dl = miss_lambda_ * course_[k].samples[j] + law_.light_noise_lambda * draw_.normal();
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
