#include "piezo_mirror.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <zlg/core/common/maths.hpp>

namespace zlg::twin {
namespace {

// Compare and select, which compiles to min and max of whole vectors.
double clipped(double x, double low, double high) {
    const double above = x < low ? low : x;
    return above > high ? high : above;
}

}  // namespace

PiezoMirror::PiezoMirror(const TwinConfig& config, double step_s)
    : is_ideal_{!(config.piezo.hysteresis > 0.0 || config.piezo.creep_per_decade > 0.0 ||
                  config.piezo.mirror_hz > 0.0)},
      step_s_{step_s} {
    const double lambda_per_v = 0.5 / config.piezo.half_wave_v;
    set_plays(config.piezo.hysteresis, 0.5 * lambda_per_v * config.piezo.hysteresis_stroke_v, 0.5);
    set_creep(config.piezo.creep_per_decade);
    set_mirror(config.piezo.mirror_hz, config.piezo.mirror_damping);
}

// A loop of the half-stroke A has the height 2 (w0 A + sum w max(A - r, 0)) and, at its middle, the width
// 2 sum w min(r, max(A - r, 0)). Two conditions give w0 and w: width = h height at the stroke S, height = stroke at the
// half-wave.
void PiezoMirror::set_plays(double hysteresis, double half_stroke, double half_wave) {
    double width = 0.0;        // of a loop of stroke S, per weight and half-stroke
    double height = 0.0;       // of the same
    double height_step = 0.0;  // of a loop as high as the half-wave
    for (std::size_t i = 0; i < n_plays; ++i) {
        const double part = (static_cast<double>(i) + 0.5) / n_plays;
        play_.threshold[i] = part * half_stroke;
        width += std::min(part, 1.0 - part);
        height += 1.0 - part;
        height_step += std::max(1.0 - play_.threshold[i] / (0.5 * half_wave), 0.0);
    }
    play_.weight = hysteresis / (width - hysteresis * (height - height_step));
    play_.direct = 1.0 - play_.weight * height_step;
}

//   c(h) = c(0) e^-x + a int e^-(x - s) y(s) ds/tau,  x = h/tau,  y even in time
void PiezoMirror::set_creep(double per_decade) {
    double time_s = 0.01;
    for (std::size_t k = 0; k < n_creeps; ++k) {
        const double x = step_s_ / time_s;
        const double gone = -core::maths::expm1(-x);
        creep_.kept[k] = core::maths::exp(-x);
        creep_.by_end[k] = per_decade * (1.0 - gone / x);
        creep_.by_start[k] = per_decade * gone - creep_.by_end[k];
        time_s *= 10.0;
    }
}

void PiezoMirror::set_mirror(double frequency_hz, double damping) {
    mirror_.is_rigid = !(frequency_hz > 0.0);
    if (mirror_.is_rigid) return;
    const double w = 2.0 * std::numbers::pi * frequency_hz;
    const double ringing = w * std::sqrt(1.0 - damping * damping);
    const double decay = core::maths::exp(-damping * w * step_s_);
    const double even = decay * core::maths::cos(ringing * step_s_);
    const double odd_s = decay * core::maths::sin(ringing * step_s_) / ringing;
    mirror_.lag_s = 2.0 * damping / w;
    mirror_.propagator[0][0] = even + damping * w * odd_s;
    mirror_.propagator[0][1] = odd_s;
    mirror_.propagator[1][0] = -w * w * odd_s;
    mirror_.propagator[1][1] = even - damping * w * odd_s;
}

double PiezoMirror::stroke_at(double voltage) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < n_plays; ++i) {
        sum += clipped(play_.position[i], voltage - play_.threshold[i], voltage + play_.threshold[i]);
    }
    return play_.direct * voltage + play_.weight * sum;
}

double PiezoMirror::creep() const {
    double sum = 0.0;
    for (const double state : creep_.state) sum += state;
    return sum;
}

double PiezoMirror::length_at(double voltage) const { return is_ideal_ ? voltage : stroke_at(voltage) + creep(); }

// The stroke grows with the voltage by w0 at least.
double PiezoMirror::voltage_for(double length) const {
    if (is_ideal_) return length;
    const double missing = std::abs(length - length_at(0.0)) / play_.direct;
    double low = -missing;
    double high = missing;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (length_at(middle) < length ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

void PiezoMirror::follow_plays(double voltage) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n_plays; ++i) {
        play_.position[i] = clipped(play_.position[i], voltage - play_.threshold[i], voltage + play_.threshold[i]);
        sum += play_.position[i];
    }
    stroke_ = play_.direct * voltage + play_.weight * sum;
}

void PiezoMirror::scale(double growth) {
    for (double& threshold : play_.threshold) threshold *= growth;
    for (double& position : play_.position) position *= growth;
    for (double& state : creep_.state) state *= growth;
    stroke_ *= growth;
    mirror_.length *= growth;
    mirror_.rate_s *= growth;
    mirror_.pull *= growth;
}

void PiezoMirror::jump(double voltage) {
    follow_plays(voltage);
    mirror_.pull = mirror_.length = stroke_ + creep();
    mirror_.rate_s = 0.0;
}

double PiezoMirror::move(double voltage) {
    const double stroke_before = stroke_;
    follow_plays(voltage);
    for (std::size_t k = 0; k < n_creeps; ++k) {
        creep_.state[k] =
            creep_.kept[k] * creep_.state[k] + (creep_.by_start[k] * stroke_before + creep_.by_end[k] * stroke_);
    }
    const double pull = stroke_ + creep();
    if (mirror_.is_rigid) return pull;
    swing(pull);
    return mirror_.length;
}

// Under an even motion the mirror lags behind by 2 zeta / w; what differs from that rings down.
void PiezoMirror::swing(double pull) {
    const double rate_s = (pull - mirror_.pull) / step_s_;
    const double behind = mirror_.lag_s * rate_s;
    const double y = mirror_.length - mirror_.pull + behind;
    const double y_rate_s = mirror_.rate_s - rate_s;
    mirror_.length = pull - behind + (mirror_.propagator[0][0] * y + mirror_.propagator[0][1] * y_rate_s);
    mirror_.rate_s = rate_s + (mirror_.propagator[1][0] * y + mirror_.propagator[1][1] * y_rate_s);
    mirror_.pull = pull;
}

}  // namespace zlg::twin
