#include <zlg/core/compensation/joint_relock.hpp>

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

double sign_of(unsigned half) noexcept { return half % 2 == 0 ? 1.0 : -1.0; }

}  // namespace

void step(const CompensationConstants& gyro, const RelockProfileConfig& config, JointRelockState& state,
          const HalfRecord& half, LightSamples light, bool measured, std::int64_t tick) noexcept {
    if (!measured) return enter_gap(state.profile);
    if (!state.profile.armed || state.profile.n_halves >= profile_halves) return;
    if (state.profile.n_halves == 0) {
        state.first_tick = tick;
        state.sign = half.bias_sign * half.mode;
        state.delivered = false;
    }
    step(gyro, config, state.profile, half, light);
}

bool is_due(const JointRelockState& state) noexcept {
    const bool broken_off = state.profile.n_halves == 0;
    return !state.delivered && (broken_off || state.profile.n_halves >= profile_halves);
}

void deliver(const CompensationConstants& gyro, JointRelockState& state, Celsius temperature,
             JointRelock& out) noexcept {
    state.delivered = true;
    const RelockProfile& profile = state.profile.profile;
    const bool complete = state.profile.n_halves >= profile_halves;
    out.first_tick = state.first_tick;
    out.known = complete && profile.known;
    if (!out.known) return;
    const double f0 = bias_at(gyro, temperature).value();
    const double arcsec = gyro.chi * f0 * gyro.scale.value() * 0.5 * gyro.tick.value();
    for (unsigned k = 0; k < profile_halves; ++k) {
        out.correction_arcsec[k] = state.sign * sign_of(k) * arcsec * profile.mean_sq_lambda2[k];
        out.known = out.known && is_finite(out.correction_arcsec[k]);
        for (unsigned l = 0; l < profile_halves; ++l) {
            const double covariance = sign_of(k) * sign_of(l) * arcsec * arcsec * profile.covariance_lambda4[k][l];
            out.covariance_arcsec2[k][l] = covariance;
            out.known = out.known && is_finite(covariance);
        }
    }
}

}  // namespace zlg::core
