#pragma once
// What every fidelity of the twin answers to.

#include <zlg/twin/twin_half.hpp>

namespace zlg::twin {

class Gyro {
public:
    Gyro() = default;
    Gyro(const Gyro&) = delete;
    Gyro& operator=(const Gyro&) = delete;
    virtual ~Gyro() = default;
    // What happened in the next half; until the next call.
    virtual const TwinHalf& advance(const core::ActuatorFrame& actuator) = 0;
};

}  // namespace zlg::twin
