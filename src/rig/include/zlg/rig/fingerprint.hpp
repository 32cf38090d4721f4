#pragma once
// The fingerprint of a run: 64 bits that stand for all that passed between the gyro, its processor and the outside.
//
// A configuration and a seed name one run, on every machine. Two runs with the same fingerprint agree to the last bit
// in every sensor frame, actuator frame, half record, truth and angle; docs/logs.md says how the bits are made.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include <zlg/core/records.hpp>
#include <zlg/rig/closed_loop.hpp>

namespace zlg::rig {

class Fingerprint {
public:
    // Of a gyro of fidelity `events` it is none of a gyro that lives every half.
    explicit Fingerprint(bool of_events = false) : before_last_{of_events ? 1u : 0u} {}

    // Each half in its order, with the frame that it began from.
    void take(const LoopHalf& half, const core::SensorFrame& sensor);
    // A leap between two halves.
    void take(const Leap& leap);
    // Each row of the angle log in its order, before or after the halves that it comes from.
    void take(const core::AngleRow& row);

    // Of what was taken until now.
    [[nodiscard]] std::uint64_t value() const;
    // The same as 16 hexadecimal digits.
    [[nodiscard]] std::string text() const;

private:
    // More than a half can hold: 64 samples of both beams, 16 set-points and fewer than 50 other numbers.
    static constexpr std::size_t max_half_bytes = 4 * 2 * core::max_light_samples + 8 * core::max_set_points + 8 * 50;

    [[nodiscard]] std::uint64_t halves() const;

    // The bytes of a half are hashed when the next half comes. Just written, numbers of different sizes cannot be read
    // as whole words yet; and a hash mostly waits for its own products, beside which the processor lays out the next
    // half.
    std::array<unsigned char, max_half_bytes> last_half_;
    std::size_t n_last_half_ = 0;
    std::uint64_t before_last_;  // hash of the halves before it
    std::uint64_t rows_ = 0;
};

}  // namespace zlg::rig
