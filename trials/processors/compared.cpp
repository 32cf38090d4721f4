#include <zlg/trials/compared.hpp>

#include <fmt/format.h>

namespace zlg::trials {

template <class Output> void ComparedProcessor::compare(const Output& here, const Output& there) {
    hash_.add(here);
    const std::string name = trials::first_difference(here, there);
    if (name.empty()) return;
    if (differing_ == 0) first_difference_ = fmt::format("half {}: {}", halves_, name);
    ++differing_;
}

core::ActuatorFrame ComparedProcessor::start(const rig::ProcessorSettings& settings) {
    const core::ActuatorFrame there = other_.start(settings);
    compare(gyro_.start({settings.control, settings.compensation}), there);
    return there;
}

rig::ProcessorHalf ComparedProcessor::half(const core::SensorFrame& frame) {
    const rig::ProcessorHalf there = other_.half(frame);
    compare(gyro_.half(frame), firmware::HalfOutput{there.control, there.compensation});
    ++halves_;
    return there;
}

core::DrainOutput ComparedProcessor::drain() {
    const core::DrainOutput there = other_.drain();
    compare(gyro_.drain(), there);
    return there;
}

}  // namespace zlg::trials
