// Frames of gyros of every kind, and what the core of this program makes of them: the input of zlg_core_replay.
//
// usage: zlg_core_frames GYRO_MINUTES [SEED] > FILE
//
// Scenarios of 20 s: a byte 2 and the settings, then for each half a byte 1 and its frame, as they lie in memory; a byte 0
// ends it. On the standard error the hash of all outputs.

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

#include <zlg/firmware/gyro.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/trials/output_bits.hpp>
#include <zlg/trials/scenarios.hpp>

namespace {

using namespace zlg;

template <class T>
void put(const T& value) {
    if (std::fwrite(&value, sizeof value, 1, stdout) != 1) std::exit(3);
}

// Runs the core here, and writes what it is given.
class Recorder final : public rig::Processor {
public:
    core::ActuatorFrame start(const rig::ProcessorSettings& s) override {
        const firmware::Settings settings{s.control, s.compensation};
        put(settings);
        return gyro_.start(settings);
    }
    rig::ProcessorHalf half(const core::SensorFrame& frame) override {
        put(std::uint8_t{1});
        put(frame);
        const firmware::HalfOutput out = gyro_.half(frame);
        hash_.add(out);
        return {out.control, out.compensation, gyro_.state().control.half_wave};
    }
    core::DrainOutput drain() override {
        const core::DrainOutput out = gyro_.drain();
        hash_.add(out);
        return out;
    }
    [[nodiscard]] std::uint64_t hash() const { return hash_.value(); }

private:
    firmware::Gyro gyro_;
    trials::BitHash hash_;
};

}  // namespace

int main(int argc, char** argv) {
    const std::int64_t scenarios = 3 * (argc > 1 ? std::atoll(argv[1]) : 1);
    const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
    Recorder recorder;
    for (std::int64_t k = 0; k < scenarios; ++k) {
        const trials::Scenario s = trials::scenario(seed, k, 20.0);
        put(std::uint8_t{2});
        rig::ClosedLoop loop{s.config, rig::motion(s.config), &recorder};
        for (int half = 0; half < 2 * rig::run_ticks(s.config, rig::motion(s.config)); ++half) (void)loop.advance();
        rig::hand_over_rest([&] { return recorder.drain(); }, rig::ignored);
    }
    put(std::uint8_t{0});
    fmt::print(stderr, "{:016x}\n", recorder.hash());
}
