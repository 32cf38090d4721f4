#pragma once
// Random numbers by address: each is a function of where it belongs, not of how many were drawn before it. See
// docs/same_run.md.
//
// The generator is Philox4x32-10 (philox.hpp). Its key is the seed; its counter of 128 bits is
//
//   bits 127..112  cause
//        111..64   half
//         63..32   gyro
//             31   1: normal deviates, 0: bits and uniform numbers
//         30..0    block: index/4 of normal deviates, index/2 of bits and uniform numbers
//
// Different addresses, and the two kinds at one address, have no block in common. Bits and uniform numbers of one index
// are the same number. All functions give the same bits on every machine.

#include <cstdint>
#include <span>

namespace zlg::chance {

// What a random number is drawn for. Two causes never share a number, so that drawing more for one changes no other.
//
// All causes stand here, so that no two users take the same by accident. A new one goes to the end of its
// range, and none is taken away: the numbers of the others would change, and with them the runs of a seed.
enum class Cause : std::uint16_t {
    // 0x0000..0x00ff: the twin
    light = 0x0001,
    random_walk,
    adc,
    dark_counts,
    start_phase,
    coil,
    fringe,
    fringe_jitter,
    leap,
    quantum,

    // 0x0100..0x01ff: its faults
    faults = 0x0100,
    fault_times,
    faulty_light,

    // 0x0200..0x02ff: the paper recomputed
    phase_at_switch = 0x0200,

    // 0x0300..0x03ff: many gyros
    sweep_seed = 0x0300,
    sweep_parameter,
    sweep_order,
    sweep_shift,

    // 0x8000..0xffff: campaigns, benchmarks and tests
    synthetic_motion = 0x8000,
    synthetic_gyro,
    vehicle,
    vehicle_motion,
    manoeuvre,
    manoeuvre_step,
    switch_start,
    switch_opening,
    sigma_gyro,
    gap_gyro,
    field_pulse,
    drift_motion,
    noise_gyro,
    noise_record,
    deviation_record,
    magnetic_base,
    magnetic_walk,
    magnetic_end,
    scenario,
    fault_trial,
    random_gyro,
    wire_damage,
    event_gyro,
    environment,
    benchmark = 0xfffe,
    test = 0xffff,
};

struct Address {
    std::uint64_t seed = 0;
    std::uint32_t gyro = 0;
    Cause cause{};
    // Half-period or trial, below 2^48 (22 000 years): asserted; without assertions numbers repeat from there on.
    std::uint64_t half = 0;

    friend bool operator==(const Address&, const Address&) = default;
};

// 64 random bits.
[[nodiscard]] std::uint64_t bits(const Address& address, std::uint32_t index) noexcept;

// Uniform in [0, 1): a multiple of 2^-53, the upper 53 of the bits.
[[nodiscard]] double uniform(const Address& address, std::uint32_t index) noexcept;

// Normal deviate of zero mean and unit variance.
//
// Box and Muller's transform (G. E. P. Box, M. E. Muller, Ann. Math. Stat. 29, 1958, 610) of 64 bits makes two of them,
// x and y:
//
//   u = (k + 1/2) 2^-40, k of 40 bits         phi = (pi/4)(2 (j + 1/2) 2^-22 - 1), j of 22 bits
//   x = +-sqrt(-ln u) (cos phi - sin phi)     y = +-sqrt(-ln u) (cos phi + sin phi), a bit for each sign
//
// that is r cos and r sin of r = sqrt(-2 ln u) and an angle from a grid of 2^-24 turns, half a step off the axes. As a
// law:
// - |x| <= sqrt(82 ln 2) = 7.54
// - the variance is 1 - ln 2/2^41, mean, skewness and all other odd moments are zero
// - the distribution function departs from the normal one at x by at most 2^-41 + min(2^-24, 1.4e-14/|x|), and the
//   part beyond x is too small by 5e-9 of itself at x = 5, 2e-6 at 6, 0.3 % at 7
// - computed to 1e-10 of the radius, which is far finer than the grid of the angle
[[nodiscard]] double normal(const Address& address, std::uint32_t index) noexcept;

// The normal deviates first, first + 1, ... of the address, bit for bit those that normal() gives. Many at once cost
// less each.
//
// first  a multiple of 4: asserted; no index may pass 2^32.
void normals(const Address& address, std::span<double> out, std::uint32_t first = 0) noexcept;

}  // namespace zlg::chance
