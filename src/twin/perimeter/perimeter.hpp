#pragma once
// Length of the ring: the piezo's part and the block's own, under whoever holds it.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/twin/twin_config.hpp>

#include "analog_loop.hpp"
#include "converters.hpp"
#include "faults/faulty_half.hpp"
#include "high_voltage.hpp"
#include "laser/laser.hpp"
#include "piezo_mirror.hpp"

namespace zlg::twin {

class Perimeter {
public:
    // n_steps  equal steps in which a half-period is lived through.
    // signal   of a laser's light, for the analog loop; null: the linear law.
    Perimeter(const TwinConfig& config, int n_steps, std::shared_ptr<const ErrorSignal> signal = nullptr);

    // Obey a frame from the start of a half on, while the block's own length moves evenly from start to end.
    //
    // errors  std::invalid_argument for a frame that no hardware could obey; nothing has changed then.
    //
    // faulty  what faults make of the half; null: nothing. It must live as long as the half.
    void begin_half(const core::ActuatorFrame& frame, double drift_start_lambda, double drift_end_lambda,
                    const FaultyHalf* faulty = nullptr);
    // From here on half a wavelength takes another voltage; the voltage stays, the length follows.
    void take_half_wave(double half_wave_v);
    // Live through the half that was begun.
    //
    // length_lambda  written: the length at its start and after each of its steps, n_steps + 1 numbers.
    // return         whether the loop was linear throughout: closed, and within the straight part of its error signal.
    bool live(std::span<double> length_lambda);

    // Let halves pass in which the loop holds its detuning while the block grows and the half-wave voltage changes.
    //
    // return  by how much the set-point of a digital loop has followed, V.
    double leap(std::int64_t halves, double drift_lambda, double half_wave_v);
    // Of the piezo after that, within the range or not.
    [[nodiscard]] double voltage_after(double drift_lambda, double half_wave_v) const;

    // The mode that lases now: the nearest.
    [[nodiscard]] const Mode& mode() const { return mode_; }
    [[nodiscard]] double length_lambda() const { return v_ + excess_ + drift_; }
    [[nodiscard]] double voltage_v() const;

private:
    [[nodiscard]] double drift_at(int step) const {
        const double drift = drift_start_ + drift_step_ * step;
        return faulty_ ? drift + faulty_->length_lambda[static_cast<std::size_t>(step)] : drift;
    }
    // Throughout the step that ends now.
    [[nodiscard]] bool is_dark() const {
        return faulty_ && faulty_->light[static_cast<std::size_t>(steps_done_ - 1)].is_dark();
    }
    void step();
    [[nodiscard]] bool live_linear(std::span<double> length_lambda);
    void take_set_points(const core::ActuatorFrame& frame);
    void leave(int polarity);
    void aim();
    void close();
    [[nodiscard]] double pinned_at(double piezo_length_lambda) const;
    void follow_set_points();
    void follow_exponential();

    TwinConfig config_;
    int n_steps_;
    double step_s_;
    HighVoltage stage_;
    double settled_lambda_;  // detuning at which the light says that there is none
    Converter dac_;
    AnalogLoop loop_;
    PiezoMirror piezo_;

    // All lengths in wavelengths; v and command count from the middle of the range.
    double v_ = 0.0;
    double excess_ = 0.0;  // of the piezo's length over v
    double command_ = 0.0;
    double drift_ = 0.0;
    double drift_start_ = 0.0;
    double drift_step_ = 0.0;
    int steps_done_ = 0;
    Mode mode_;
    const FaultyHalf* faulty_ = nullptr;
    double switch_error_ = 0.0;  // of the last opening

    // A mode nearer to its centre than this, of the helicity that the reference asks for, is held.
    static constexpr double held_lambda = 0.1;

    bool closed_ = true;
    int polarity_ = 1;
    int held_before_ = 0;    // helicity of the mode that the loop held when it opened last; 0: none
    int missed_from_ = 0;    // the same, of the last move that had a miss
    bool has_miss_ = false;  // the present move carries the miss that is asked for
    std::vector<double> set_points_;
    double injected_ = 0.0;   // error of the second input
    double direction_ = 1.0;  // of the last move in the open loop

    // The exponential loop: dl = amplitude exp(-t/tau) about the place where it settles.
    double centre_;
    double miss_at_closing_ = 0.0;
    double amplitude_ = 0.0;  // at the start of the half
    double halves_since_closing_ = 0.0;
    std::vector<double> decay_;  // after each step of a half
};

}  // namespace zlg::twin
