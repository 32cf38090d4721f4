// The core alone on the frames of zlg_core_frames: prints the hash of all its outputs.
//
// It needs nothing but the core, so bench/core_bits can build it with one compiler after the other.

#include <cstdint>
#include <cstdio>

#include <zlg/firmware/gyro.hpp>
#include <zlg/trials/output_bits.hpp>

namespace {

using namespace zlg;

template <class T>
bool get(T& value) {
    return std::fread(&value, sizeof value, 1, stdin) == 1;
}

firmware::Gyro gyro;
trials::BitHash hash;

void drain() {
    core::DrainOutput rest;
    do {
        rest = gyro.drain();
        hash.add(rest);
    } while (rest.has_row || rest.has_gap);
}

}  // namespace

int main() {
    bool running = false;
    for (std::uint8_t what = 0; get(what);) {
        if (what != 1 && running) drain();
        running = what != 0;
        firmware::Settings settings;
        core::SensorFrame frame;
        if (what == 0) {
            std::printf("%016llx\n", static_cast<unsigned long long>(hash.value()));
            return 0;
        }
        if (what == 2 ? !get(settings) : !get(frame)) break;
        if (what == 2)
            (void)gyro.start(settings);
        else
            hash.add(gyro.half(frame));
    }
    std::fprintf(stderr, "zlg_core_replay: the input ends early\n");
    return 3;
}
