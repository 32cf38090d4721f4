#pragma once
// A processor held against this program: both run the core on the same frames, and every bit must be the same.

#include <cstdint>
#include <string>

#include <zlg/firmware/gyro.hpp>
#include <zlg/rig/processor.hpp>
#include <zlg/trials/output_bits.hpp>

namespace zlg::trials {

class ComparedProcessor final : public rig::Processor {
public:
    // other  outlives this object; its answers are what this one answers.
    explicit ComparedProcessor(rig::Processor& other) : other_{other} {}

    // errors  those of the other.
    core::ActuatorFrame start(const rig::ProcessorSettings& settings) override;
    rig::ProcessorHalf half(const core::SensorFrame& frame) override;
    core::DrainOutput drain() override;

    // Since this object was made.
    [[nodiscard]] std::int64_t halves() const { return halves_; }
    [[nodiscard]] std::int64_t differing() const { return differing_; }  // outputs, of halves and others
    // Where the first one was and in what: empty where every bit is the same.
    [[nodiscard]] const std::string& first_difference() const { return first_difference_; }
    [[nodiscard]] std::uint64_t hash() const { return hash_.value(); }  // of this program's outputs

    // What this program remembers, to be held against the other.
    [[nodiscard]] const firmware::GyroState& state() const { return gyro_.state(); }

private:
    template <class Output> void compare(const Output& here, const Output& there);

    rig::Processor& other_;
    firmware::Gyro gyro_;
    BitHash hash_;
    std::int64_t halves_ = 0;
    std::int64_t differing_ = 0;
    std::string first_difference_;
};

}  // namespace zlg::trials
