#pragma once
// What every fidelity of the twin answers to.

#include <cstdint>

#include <zlg/twin/leap.hpp>
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

    // As the functions of Twin; a gyro that cannot leap has no quiet half.
    virtual std::int64_t quiet_halves() { return 0; }
    virtual std::int64_t even_halves() { return 0; }
    virtual double voltage_after(std::int64_t) { return 0.0; }
    virtual Leap leap(std::int64_t, const LeapWay&) { return {}; }
};

}  // namespace zlg::twin
