#pragma once
// Faults between the converters and the processor: codes, counter and delivery of frames.

#include <span>

#include <zlg/core/records.hpp>
#include <zlg/twin/faults.hpp>

#include "noise.hpp"

namespace zlg::twin {

class FrameFaults {
public:
    explicit FrameFaults(std::uint64_t seed) : seed_{seed} {}

    // What the processor gets instead of the frame that was latched at the end of the half.
    void act(std::span<const Fault> active, std::uint64_t half, double half_s, core::SensorFrame& sensor);

private:
    void spoil_light(const Fault& fault, std::uint64_t half, double half_s, core::SensorFrame& sensor);
    void spoil_slow(const Fault& fault, core::SensorFrame& sensor) const;
    void deliver(std::span<const Fault> active, double end_s, core::SensorFrame& sensor);

    std::uint64_t seed_;
    bool has_latched_ = false;
    bool late_before_ = false;       // the frame before was late
    core::SensorFrame latched_{};    // of the half before, as the electronics made it
    core::SensorFrame delivered_{};  // as the processor got it
};

}  // namespace zlg::twin
