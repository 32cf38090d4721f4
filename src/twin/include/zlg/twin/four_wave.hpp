#pragma once
// The laser of a Zeeman gyro at one perimeter and one field, computed exactly.
//
// Four waves: two helicities (left, right) by two directions (cw, ccw). The mode nearest to the line centre and its
// neighbour of the other helicity, half a free spectral range away, share the gas. Wave i runs along s_i = +-1 at the
// frequency nu_i; the field shifts its line by z_i. W is the distribution of velocities, k counts the isotopes:
//
//   L_ik(v) = gamma^2 / (gamma^2 + (nu_i - nu_k - z_i - s_i v)^2)
//   g_i = sum_k f_k int W L_ik           theta_ij = p_ij sum_k f_k int W L_ik L_jk
//   dI_i/dt ~ I_i (G g_i - mu - G sum_j theta_ij I_j)
//   pulling_i = -FSR/(2 pi) G/2 sum_k f_k int W gamma (nu_i - nu_k - z_i - s_i v) / (gamma^2 + (...)^2)
//
//
// The matrix theta is a Gram matrix times, element by element, a matrix p that is positive semidefinite for p_ij in
// 0..1. So the intensities climb a concave hill: one stable state, reached from any start, continuous in detuning and
// field, without hysteresis.

#include <memory>

#include <zlg/twin/laser_config.hpp>

namespace zlg::twin {

// The two waves of one helicity. Intensities are in units of the saturation intensity.
struct WavePair {
    double cw = 0.0;
    double ccw = 0.0;
    double bias_hz = 0.0;  // pulling of cw minus that of ccw, whether or not they are lit

    [[nodiscard]] bool two_way() const { return cw > 0.0 && ccw > 0.0; }
    [[nodiscard]] bool dark() const { return !(cw > 0.0 || ccw > 0.0); }
};

struct LaserLight {
    WavePair left;   // helicity +1
    WavePair right;  // helicity -1

    [[nodiscard]] const WavePair& of(int helicity) const { return helicity > 0 ? left : right; }

    // What a photodiode in each direction sees: the light of both helicities.
    [[nodiscard]] double cw() const { return left.cw + right.cw; }
    [[nodiscard]] double ccw() const { return left.ccw + right.ccw; }

    // (cw - ccw) / (cw + ccw) of those; 0 in the dark.
    [[nodiscard]] double discriminator() const {
        const double sum = cw() + ccw();
        return sum > 0.0 ? (cw() - ccw()) / sum : 0.0;
    }

    // Which waves are lit: left cw 1, left ccw 2, right cw 4, right ccw 8.
    [[nodiscard]] unsigned lit() const {
        return (left.cw > 0.0 ? 1U : 0U) | (left.ccw > 0.0 ? 2U : 0U) | (right.cw > 0.0 ? 4U : 0U) |
               (right.ccw > 0.0 ? 8U : 0U);
    }
};

class Gas;

class FourWave {
public:
    // errors  std::invalid_argument as validate(LaserConfig).
    explicit FourWave(const LaserConfig& config);

    // perimeter_lambda  in wavelengths; left modes are centred at whole ones, right modes between. Within +-1e6.
    // field_g           along the cw direction, finite; positive raises the left cw line by the Zeeman shift.
    // accuracy          integrals to 1e-12. Of waves that burn the very same hole (one isotope, coupling 1, no field,
    //                   zero detuning) which one lives is arbitrary.
    // cost              about 1.1 us.
    [[nodiscard]] LaserLight at(double perimeter_lambda, double field_g) const;

    // Intensity of either left wave at zero perimeter and zero field, by which others are judged.
    [[nodiscard]] double centre_intensity() const { return centre_intensity_; }

    [[nodiscard]] const LaserConfig& config() const { return config_; }

private:
    LaserConfig config_;
    std::shared_ptr<const Gas> gas_;
    double centre_intensity_ = 0.0;
};

}  // namespace zlg::twin
