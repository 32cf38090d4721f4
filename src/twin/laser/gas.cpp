#include "gas.hpp"

#include <algorithm>
#include <numbers>

#include "light.hpp"

namespace zlg::twin {
namespace {

constexpr std::array<double, n_waves> direction{1.0, -1.0, 1.0, -1.0};
constexpr std::array<double, n_waves> shift_sign{1.0, -1.0, -1.0, 1.0};

}  // namespace

Gas::Gas(const LaserConfig& c)
    : line_{0.5 * c.isotope_shift_hz / c.doppler_half_width_hz, -0.5 * c.isotope_shift_hz / c.doppler_half_width_hz},
      share_{c.upper_isotope_ratio, 1.0 - c.upper_isotope_ratio},
      half_width_{c.homogeneous_half_width_hz / c.doppler_half_width_hz},
      spectral_range_{light_m_s / c.perimeter_m / c.doppler_half_width_hz},
      shift_per_g_{c.zeeman_hz_per_g / c.doppler_half_width_hz},
      opposite_coupling_{c.opposite_sigma_coupling},
      loss_{c.round_trip_loss_ratio} {
    gain_ = c.gain_loss_ratio / gain_loss(0.0);
    pulling_hz_ = light_m_s / c.perimeter_m / (2.0 * std::numbers::pi) * 0.5 * gain_;
}

double Gas::gain_loss(double detuning_lambda) const {
    double line = 0.0;
    for (unsigned k = 0; k < n_isotopes; ++k) {
        line += share_[k] * average_line(Hole{detuning_lambda * spectral_range_ - line_[k], half_width_});
    }
    return gain_ * line / loss_;
}

FrameLight GasPoint::light(const Balance& balance) const {
    FrameLight light{{}, near_bias_hz, far_bias_hz};
    for (unsigned i = 0; i < n_waves; ++i)
        if (balance.lit >> i & 1U) light.intensity[i] = std::max(balance.value[i], 0.0);
    return light;
}

// A wave that runs backwards meets the velocity of its own hole with the other sign: the hole lies at s Delta, and
// its dispersion, odd in Delta, carries the sign s.
GasPoint Gas::at(double near_lambda, double far_lambda, double shift) const {
    GasPoint point;
    std::array<double, n_waves> dispersion{};
    auto& saturation = point.competition.saturation;
    point.competition.net_gain.fill(-loss_);
    for (unsigned k = 0; k < n_isotopes; ++k) {
        const auto hole = [&](unsigned i) {
            const double frequency = (i < 2 ? near_lambda : far_lambda) * spectral_range_;
            return Hole{direction[i] * (frequency - line_[k] - shift_sign[i] * shift), half_width_};
        };
        const std::array<Hole, n_waves> holes{hole(0), hole(1), hole(2), hole(3)};
        const double gain = gain_ * share_[k];
        for (unsigned i = 0; i < n_waves; ++i) {
            point.competition.net_gain[i] += gain * average_line(holes[i]);
            dispersion[i] += share_[k] * direction[i] * average_dispersion(holes[i]);
            for (unsigned j = 0; j <= i; ++j) {
                saturation[i][j] += gain * coupling(i, j) * average_overlap(holes[i], holes[j]);
                saturation[j][i] = saturation[i][j];
            }
        }
    }
    point.near_bias_hz = pulling_hz_ * (dispersion[1] - dispersion[0]);
    point.far_bias_hz = pulling_hz_ * (dispersion[3] - dispersion[2]);
    return point;
}

double Gas::coupling(unsigned i, unsigned j) const { return shift_sign[i] == shift_sign[j] ? 1.0 : opposite_coupling_; }

}  // namespace zlg::twin
