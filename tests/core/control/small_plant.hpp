#pragma once
// A gyro of a few lines, to close the loop in tests: perimeter, high-voltage stage, two beams, counter.
//
// It is reversed and latched on command.
//
//   y = kp U + drift,  centre m/2 nearest to y,  helicity (-1)^m,  dl = y - m/2,  kp = 0.5/half_wave

#include <zlg/core/control/perimeter_loop.hpp>
#include <zlg/core/records.hpp>

#include "support.hpp"

namespace zlg::core::test {

class SmallPlant {
public:
    explicit SmallPlant(LoopKind loop) : loop_{loop} {}

    double half_wave_v = 40.0;
    double drift_lambda = 0.0;
    double rate_counts = 50.0;  // per half, of the rotation
    bool lamp_on = true;
    bool stage_stuck = false;
    std::uint64_t counter = 0;
    double voltage_v = 160.0;
    double miss_lambda = 0.0;  // detuning at the last closing, signed

    SensorFrame advance(const ActuatorFrame& a) {
        if (a.loop_closed && !closed_) {
            command_v_ = voltage_v;
            miss_lambda = detuning_lambda();
        }
        closed_ = a.loop_closed;
        polarity_ = a.polarity;
        const int sign = half_ % 2 == 0 ? 1 : -1;
        SensorFrame f;
        f.n_light = n_samples;
        f.has_light_b = true;
        const double length_s = half_s + (a.edge_offset_ticks - start_ticks_) / 1e7;
        start_ticks_ = a.edge_offset_ticks;
        double cycles = rate_counts * length_s / half_s;
        for (std::size_t k = 0; k < n_samples; ++k) {
            const double set_point_v = a.set_point_v[k * a.n_set_points / n_samples];
            for (int piece = 0; piece < 8; ++piece) follow(set_point_v, length_s / (8.0 * n_samples));
            const double dl = detuning_lambda();
            const double signal = sign * helicity() * 0.332 * dl;
            const bool two_way = std::abs(dl) < 0.24;
            f.light_a[k] = static_cast<float>(!lamp_on ? 0.0 : two_way ? 1000.0 * (1.0 + signal) : 1000.0);
            f.light_b[k] = static_cast<float>(!lamp_on || !two_way ? 0.0 : 1000.0 * (1.0 - signal));
            cycles += sign * helicity() * 60e3 * (1.0 - 3.6 * dl * dl) * length_s / n_samples;
        }
        phase_ += cycles;
        const double whole = std::floor(phase_);
        phase_ -= whole;
        counter += static_cast<std::uint64_t>(static_cast<std::int64_t>(whole));
        f.sequence = static_cast<std::uint32_t>(half_);
        f.timer_ticks = static_cast<std::uint64_t>((half_ + 1) * 25000 + a.edge_offset_ticks);
        f.counter = counter;
        f.bias_sign = static_cast<std::int8_t>(sign);
        f.polarity = a.polarity;
        f.loop_closed = a.loop_closed;
        f.piezo_v = voltage_v;
        f.temperature_c = 25.0;
        f.coil_current_a = sign * 1.0;
        ++half_;
        return f;
    }

    [[nodiscard]] double detuning_lambda() const { return length() - 0.5 * std::round(2.0 * length()); }
    [[nodiscard]] int helicity() const {
        return static_cast<std::int64_t>(std::round(2.0 * length())) % 2 == 0 ? 1 : -1;
    }

private:
    static constexpr std::uint8_t n_samples = 16;
    static constexpr double half_s = 0.0025;

    [[nodiscard]] double length() const { return 0.5 * voltage_v / half_wave_v + drift_lambda; }

    void follow(double set_point_v, double dt_s) {
        double command_v = set_point_v;
        if (closed_ && loop_ == LoopKind::analog) {
            const double error = polarity_ * helicity() * detuning_lambda();
            const bool lit = lamp_on && std::abs(detuning_lambda()) < 0.24;
            if (lit) command_v_ -= std::fmin(std::fmax(error, -0.09), 0.09) * 2.0 * half_wave_v * dt_s / 0.0065;
            command_v_ = std::fmin(std::fmax(command_v_, 0.0), 300.0);
            command_v = command_v_;
        }
        if (stage_stuck) return;
        const double rate_v_s = std::fmin(std::fmax((command_v - voltage_v) / 0.001, -4000.0), 4000.0);
        voltage_v += rate_v_s * dt_s;
    }

    LoopKind loop_;
    bool closed_ = true;
    int polarity_ = 1;
    double command_v_ = 160.0;
    double phase_ = 0.0;
    std::int64_t half_ = 0;
    std::int32_t start_ticks_ = 0;  // shift of the reversal that begins the next half
};

}  // namespace zlg::core::test
