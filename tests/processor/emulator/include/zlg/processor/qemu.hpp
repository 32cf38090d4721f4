#pragma once
// The image of the gyro's processor in QEMU, half-period by half-period through memory that both see.

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <zlg/firmware/exchange.hpp>
#include <zlg/firmware/gyro.hpp>
#include <zlg/rig/processor.hpp>

namespace zlg::processor {

struct QemuOptions {
    std::string image;                        // the file of the image, ELF
    std::string program = "qemu-system-arm";  // by its path, or by its name in PATH
    int timeout_ms = 20'000;                  // longest time without an answer, the start included; 1 or more
    std::string line = "null";  // where the serial line of telemetry and commands leads, as the emulator names it
    std::string stored;         // a file of stored settings that lie in its flash; none: nothing is stored
    bool counts_instructions = false;  // a tick of the processor's timers is then a fixed number of them; slower
};

// The emulator is not there, does not answer, or ends; the image is not of this program.
struct QemuError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// The emulator lives as long as this object and ends with it, also when the program is killed.
class QemuProcessor final : public rig::Processor {
public:
    // errors  QemuError, here and in every other function.
    explicit QemuProcessor(const QemuOptions& options);
    ~QemuProcessor() override;

    core::ActuatorFrame start(const rig::ProcessorSettings& settings) override;
    // The same with the settings in its flash.
    core::ActuatorFrame start_stored();
    rig::ProcessorHalf half(const core::SensorFrame& frame) override;
    core::DrainOutput drain() override;

    // All that the image remembers.
    [[nodiscard]] firmware::GyroState state();

    // The most that the image's stack has held since it was started.
    [[nodiscard]] std::uint32_t stack_used_bytes();

private:
    class Link;

    core::ActuatorFrame begin(firmware::Request request);
    void give_pulse(std::uint64_t now_ticks);

    std::unique_ptr<Link> link_;
    std::optional<std::uint64_t>
        first_ticks_;  // stamp of the first frame since the start, which comes with the first pulse
};

}  // namespace zlg::processor
