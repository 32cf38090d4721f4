#pragma once
// A gyro's processor that is not this program: it runs the core somewhere else, in lock step with the twin.

#include <zlg/config/config.hpp>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/gyro_control.hpp>

namespace zlg::rig {

struct ProcessorSettings {
    core::GyroControlConfig control{};
    core::GyroCompensationConfig compensation{};
};

struct ProcessorHalf {
    core::GyroControlOutput control{};
    core::CompensationOutput compensation{};
};

// What a processor runs by that is the gyro of this configuration: where its schedule asks for measurements, with the
// magnetic drift at least watched.
//
// errors  config::ConfigError.
[[nodiscard]] ProcessorSettings processor_settings(const config::Config& config);

class Processor {
public:
    virtual ~Processor() = default;

    // Begin anew with settings that have passed `check`.
    //
    // return  what is in force in the first half.
    virtual core::ActuatorFrame start(const ProcessorSettings& settings) = 0;

    // One half-period: control, and compensation of its record.
    virtual ProcessorHalf half(const core::SensorFrame& frame) = 0;

    // One more report of the angle that is outstanding at the end, at each call, until there is none.
    virtual core::DrainOutput drain() = 0;
};

}  // namespace zlg::rig
