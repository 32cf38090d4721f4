#pragma once
// What the piezo makes of its voltage: hysteresis, creep and the resonance of the mirror.
//
//   y = w0 v + sum_i w_i p_i            play operators p_i <- clip(p_i, v - r_i, v + r_i)
//   dc_k/dt = (a y - c_k)/tau_k         creep of the stroke, tau_k = 10 ms .. 10^4 s, one each decade
//   x'' + 2 zeta w x' + w^2 x = w^2 (y + sum_k c_k)
//
// All lengths in wavelengths, voltages as the change of perimeter that an ideal piezo makes of them, both from the
// middle of the range. Thresholds r_i lie evenly between 0 and half of the stroke S of the loop whose width, over its
// height, is the hysteresis h. The weights follow from h and from what the half-wave voltage means: a loop of that
// stroke moves the perimeter by half a wavelength. Before the first move no play has a memory, and nothing creeps.

#include <array>

#include <zlg/twin/twin_config.hpp>

namespace zlg::twin {

class PiezoMirror {
public:
    // step_s  of `move`.
    PiezoMirror(const TwinConfig& config, double step_s);

    // Whether the length is the voltage itself: then `move` need not be called.
    [[nodiscard]] bool is_ideal() const { return is_ideal_; }

    // Length after one step, at whose end the voltage is `voltage`. No turn is seen within a step; creep and resonance
    // are exact for a stroke that moves evenly.
    double move(double voltage);

    // Let every length that belongs to a voltage grow.
    void scale(double growth);

    // The voltage at once at another value, the mirror at rest there.
    void jump(double voltage);

    // Length at rest after a direct move to a voltage, and the voltage that a direct move must reach; neither moves.
    [[nodiscard]] double length_at(double voltage) const;
    [[nodiscard]] double voltage_for(double length) const;

private:
    static constexpr std::size_t n_plays = 10;
    static constexpr std::size_t n_creeps = 7;

    struct Play {
        std::array<double, n_plays> threshold{};
        std::array<double, n_plays> position{};
        double weight = 0.0;  // of each
        double direct = 1.0;  // w0
    };

    struct Creep {
        std::array<double, n_creeps> state{};
        std::array<double, n_creeps> kept{};      // part of the state that a step leaves
        std::array<double, n_creeps> by_start{};  // of the stroke at the start and at the end of a step
        std::array<double, n_creeps> by_end{};
    };

    struct Mirror {
        bool is_rigid = true;
        double lag_s = 0.0;         // behind an even motion: 2 zeta / w
        double propagator[2][2]{};  // over (length, its rate), both relative to the even motion
        double length = 0.0;
        double rate_s = 0.0;  // wavelengths per second
        double pull = 0.0;    // stroke and creep at the end of the last step
    };

    void set_plays(double hysteresis, double half_stroke, double half_wave);
    void set_creep(double per_decade);
    void set_mirror(double frequency_hz, double damping);
    void follow_plays(double voltage);
    void swing(double pull);
    [[nodiscard]] double stroke_at(double voltage) const;
    [[nodiscard]] double creep() const;

    bool is_ideal_;
    double step_s_;
    Play play_;
    Creep creep_;
    Mirror mirror_;
    double stroke_ = 0.0;
};

}  // namespace zlg::twin
