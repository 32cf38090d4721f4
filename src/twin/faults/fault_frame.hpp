#pragma once
// Faults between the converters and the processor: codes, counter and delivery of frames.

#include <span>

#include <zlg/core/records.hpp>
#include <zlg/twin/faults.hpp>

#include "noise.hpp"

namespace zlg::twin {

class FrameFaults {
public:
    explicit FrameFaults(std::uint64_t seed) : light_noise_{seed, NoiseCause::faulty_light} {}

    // What the processor gets instead of the frame that was latched at end_s, the end of a half that began at start_s.
    void act(std::span<const Fault> active, double start_s, double end_s, core::SensorFrame& sensor);

private:
    void spoil_light(const Fault& fault, double start_s, double end_s, core::SensorFrame& sensor);
    void spoil_slow(const Fault& fault, core::SensorFrame& sensor) const;
    void deliver(std::span<const Fault> active, double end_s, core::SensorFrame& sensor);

    NoiseStream light_noise_;
    bool has_latched_ = false;
    bool late_before_ = false;       // the frame before was late
    core::SensorFrame latched_{};    // of the half before, as the electronics made it
    core::SensorFrame delivered_{};  // as the processor got it
};

}  // namespace zlg::twin
