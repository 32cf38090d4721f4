#include <zlg/firmware/exchange.hpp>

#include <array>

namespace zlg::firmware {

// Of the text of the core and of the headers of this folder; the build makes it.
extern const std::uint64_t core_sources;

namespace {

constexpr std::array<std::size_t, 24> sizes{sizeof(bool),
                                            alignof(bool),
                                            sizeof(int),
                                            alignof(int),
                                            sizeof(float),
                                            alignof(float),
                                            sizeof(double),
                                            alignof(double),
                                            sizeof(std::int64_t),
                                            alignof(std::int64_t),
                                            sizeof(core::RelockMethod),
                                            sizeof(core::GyroControlConfig),
                                            sizeof(core::GyroControlState),
                                            sizeof(core::GyroCompensationConfig),
                                            sizeof(core::GyroCompensationState),
                                            sizeof(core::SensorFrame),
                                            sizeof(core::ActuatorFrame),
                                            sizeof(HalfOutput),
                                            sizeof(core::DrainOutput),
                                            offsetof(Exchange, settings),
                                            offsetof(Exchange, sensor),
                                            offsetof(Exchange, output),
                                            offsetof(Exchange, state),
                                            sizeof(Exchange)};

}  // namespace

std::uint64_t layout() noexcept {
    std::uint64_t hash = core_sources;
    for (const std::size_t size : sizes) hash = (hash ^ size) * 0x100000001b3u;
    return hash;
}

}  // namespace zlg::firmware
