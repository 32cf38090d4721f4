#pragma once
// What a gyro has whatever its light does: warming, perimeter, slow channels and the clock of halves.

#include <cstdint>
#include <memory>

#include <zlg/twin/environment.hpp>
#include <zlg/twin/twin_config.hpp>
#include <zlg/twin/twin_half.hpp>

#include "beam_photodiodes.hpp"
#include "converters.hpp"
#include "counter_limit.hpp"
#include "faults/fault_frame.hpp"
#include "faults/fault_light.hpp"
#include "faults/fault_plan.hpp"
#include "faults/faulty_half.hpp"
#include "laser/error_signal.hpp"
#include "noise.hpp"
#include "perimeter/perimeter.hpp"
#include "warming.hpp"

namespace zlg::twin {

// Pieces of one light-sample interval: an odd number, so that the sample lies in the middle of a piece.
inline constexpr int max_pieces_per_sample = 65;
[[nodiscard]] int pieces_per_sample(const TwinConfig& config);

class Housing {
public:
    // config  validated.
    // signal  what the closed loop sees; null: the linear law of the averaged model.
    explicit Housing(const TwinConfig& config, std::shared_ptr<const ErrorSignal> signal = nullptr);

    // Enter the next half under a frame. The perimeter is then stepped 2 pieces light_samples times by the caller.
    //
    // errors  std::invalid_argument for a frame that no hardware could obey; nothing has changed then.
    void begin_half(const core::ActuatorFrame& actuator);
    // Leave it: the counter was latched `offset_ticks` after the end of the half.
    void end_half(const core::ActuatorFrame& actuator, std::uint64_t counter, std::int32_t offset_ticks,
                  TwinHalf& half);

    Perimeter& perimeter() { return perimeter_; }

    // Leap over so many halves; what the counter shows after them, of an ideal one. No fault acts in them.
    //
    // return  of the set-points of a digital loop, V.
    double leap(std::int64_t halves);
    void count_on(std::uint64_t counter) { counter_limit_.skip(counter); }
    // Halves from here on in which no fault acts.
    [[nodiscard]] std::int64_t halves_without_fault() const;
    // Of the piezo, when so many halves have passed.
    [[nodiscard]] double voltage_after(std::int64_t halves);
    [[nodiscard]] double temperature_c() const;
    [[nodiscard]] const BeamPhotodiodes& photodiodes() const { return photodiodes_; }
    [[nodiscard]] double shock_c() const { return shock_end_c_; }  // above what the gyro's own warming makes

    [[nodiscard]] double half_s() const { return half_s_; }
    [[nodiscard]] int n_pieces() const { return n_pieces_; }  // of one light-sample interval
    // Of the half entered, or if none is, of the next.
    [[nodiscard]] std::uint64_t index() const { return index_; }
    [[nodiscard]] double start_s() const { return static_cast<double>(index_) * half_s_; }
    [[nodiscard]] double end_s() const { return static_cast<double>(index_ + 1) * half_s_; }
    [[nodiscard]] int bias_sign() const;
    // Means over the half entered.
    [[nodiscard]] double bias_growth() const;  // 1 at the reference temperature with the coil's own current
    [[nodiscard]] double magnetic_arcsec_s() const;

    // What faults do in the half entered.
    [[nodiscard]] bool light_is_faulty() const { return faults_.dims_light(); }
    [[nodiscard]] LightParts light_at(double since_start_s) const;
    [[nodiscard]] double power() const {
        return photodiodes_.power(end_s());
    }  // of the light at the end, over that at t = 0
    [[nodiscard]] double turned_arcsec(double from_s, double to_s) const;  // beyond the motion

private:
    [[nodiscard]] double drift_lambda(double warming, double shock_c) const;
    [[nodiscard]] double warming_at(std::uint64_t half);  // as a part of gyro.temperature_rise_c, at its start
    [[nodiscard]] double above_reference_c() const;       // mean of the half entered
    [[nodiscard]] double half_wave_v() const { return half_wave_v(warming_end_) * half_wave_ratio_now(); }
    [[nodiscard]] double half_wave_v(double warming) const;
    [[nodiscard]] double half_wave_ratio_now() const;
    [[nodiscard]] double coil_ratio() const;  // of its current over its own
    void enter_faults();
    void read_slow(core::SensorFrame& sensor, double perimeter_v);

    TwinConfig config_;
    double half_s_;
    std::uint64_t half_ticks_;
    int n_pieces_;
    Converter adc_;
    Perimeter perimeter_;
    NoiseAhead<1> adc_noise_;
    Converter coil_adc_;
    NoiseAhead<1> coil_noise_;
    BeamPhotodiodes photodiodes_;
    CounterLimit counter_limit_;
    Warming warming_;
    FaultPlan faults_;
    FrameFaults frame_faults_;
    FaultyHalf faulty_half_;
    bool is_faulty_ = false;                // length, light or opening of the half entered
    std::int32_t offset_before_ticks_ = 0;  // of the latch that began the half
    std::uint64_t index_ = 0;
    double warming_first_ = 0.0;  // at the start of the run, and at the start and the end of the half
    double warming_start_ = 0.0;
    double warming_end_ = 0.0;
    double sensed_c_ = 0.0;       // by the sensor of the temperature, before its error
    double sensor_gain_ = 0.0;    // part of what it lacks that it gains in a half
    double shock_start_c_ = 0.0;  // warming by faults
    double shock_end_c_ = 0.0;
};

}  // namespace zlg::twin
