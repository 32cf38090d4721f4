#pragma once
// The fingerprint of a run: 64 bits that stand for all that passed between the gyro, its processor and the outside.
//
// A configuration and a seed name one run, on every machine. Two runs with the same fingerprint agree to the last bit in every
// sensor frame, actuator frame, half record, truth and angle; docs/logs.md says how the bits are made.

#include <cstdint>
#include <string>

#include <zlg/core/records.hpp>
#include <zlg/rig/closed_loop.hpp>

namespace zlg::rig {

class Fingerprint {
public:
    // Each half in its order, with the frame that it began from.
    void take(const LoopHalf& half, const core::SensorFrame& sensor);
    // Each row of the angle log in its order, before or after the halves that it comes from.
    void take(const core::AngleRow& row);

    // Of what was taken until now.
    [[nodiscard]] std::uint64_t value() const;
    // The same as 16 hexadecimal digits.
    [[nodiscard]] std::string text() const;

private:
    std::uint64_t halves_ = 0;
    std::uint64_t rows_ = 0;
};

}  // namespace zlg::rig
