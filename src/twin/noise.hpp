#pragma once
// Streams of random numbers, one for each cause of noise.
//
// Each stream has a seed of its own, so that switching one cause off does not shift the draws of another.

#include <cstdint>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>

namespace zlg::twin {

enum class NoiseCause : std::uint64_t {
    light = 1,
    random_walk,
    adc,
    dark_counts,
    start_phase,
    faults,
    fault_times,
    faulty_light,
    coil,
    fringe,
    fringe_jitter,
};

// Seeds that differ in one bit become unrelated (SplitMix64's output function).
inline std::uint64_t scrambled(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

class NoiseStream {
public:
    NoiseStream(std::uint64_t seed, NoiseCause cause)
        : engine_{scrambled(scrambled(seed) + static_cast<std::uint64_t>(cause))} {}

    // Zero mean, unit variance.
    double gauss() { return normal_(engine_); }
    // Uniform in [0, 1).
    double uniform() { return uniform_(engine_); }

private:
    boost::random::mt19937_64 engine_;
    boost::random::normal_distribution<double> normal_;
    boost::random::uniform_01<double> uniform_;
};

}  // namespace zlg::twin
