#include <zlg/rig/fingerprint.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>

#include <fmt/format.h>

// The hash is part of this source alone: no library has to be there where the program runs.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace zlg::rig {
namespace {

// Numbers as bytes, the lowest first, whatever the order of the machine.
template <std::size_t capacity>
class Bytes {
public:
    template <class Word>
    void word(Word value) {
        if constexpr (is_in_order)
            std::memcpy(&byte_[size_], &value, sizeof(Word));
        else
            for (std::size_t k = 0; k < sizeof(Word); ++k)
                byte_[size_ + k] = static_cast<unsigned char>(value >> (8 * k));
        size_ += sizeof(Word);
    }
    void whole(std::int64_t value) { word(static_cast<std::uint64_t>(value)); }
    // A number that is none has many patterns of bits, and machines differ in the one that they make.
    void real(double value) { word(value != value ? 0x7ff8'0000'0000'0000u : std::bit_cast<std::uint64_t>(value)); }
    void real(float value) { word(value != value ? 0x7fc0'0000u : std::bit_cast<std::uint32_t>(value)); }
    // All at once where that gives the same bytes: a half has 16 samples of each beam and more.
    void reals(std::span<const float> values) {
        bool has_none = false;
        for (const float value : values) has_none |= value != value;
        if (is_in_order && !has_none) {
            std::memcpy(&byte_[size_], values.data(), values.size_bytes());
            size_ += values.size_bytes();
            return;
        }
        for (const float value : values) real(value);
    }

    [[nodiscard]] std::uint64_t hashed(std::uint64_t seed) const { return XXH64(byte_.data(), size_, seed); }

private:
    static constexpr bool is_in_order = std::endian::native == std::endian::little;

    std::array<unsigned char, capacity> byte_;
    std::size_t size_ = 0;
};

// More than a half can hold: 64 samples of both beams, 16 set-points and fewer than 50 other numbers.
using HalfBytes = Bytes<4 * 2 * core::max_light_samples + 8 * core::max_set_points + 8 * 50>;

void put(HalfBytes& bytes, const core::SensorFrame& s) {
    bytes.whole(s.sequence);
    bytes.word(s.timer_ticks);
    bytes.word(s.counter);
    bytes.whole(s.bias_sign);
    bytes.whole(s.polarity);
    bytes.whole(s.loop_closed);
    bytes.whole(s.n_light);
    bytes.reals(std::span{s.light_a}.first(s.n_light));
    bytes.whole(s.has_light_b);
    bytes.reals(std::span{s.light_b}.first(s.has_light_b ? s.n_light : 0u));
    bytes.real(s.piezo_v);
    bytes.real(s.coil_current_a);
    bytes.real(s.temperature_c);
    bytes.whole(s.status);
    bytes.whole(s.has_fringe);
    bytes.whole(s.fringe_quarter);
    bytes.real(s.fringe_c);
    bytes.real(s.fringe_s);
}

void put(HalfBytes& bytes, const core::ActuatorFrame& a) {
    bytes.whole(a.loop_closed);
    bytes.whole(a.polarity);
    bytes.whole(a.n_set_points);
    for (const double v : std::span{a.set_point_v}.first(a.n_set_points)) bytes.real(v);
    bytes.whole(a.edge_offset_ticks);
}

void put(HalfBytes& bytes, const core::HalfRecord& r) {
    bytes.whole(r.half);
    bytes.whole(r.counts);
    bytes.real(r.detuning_lambda);
    bytes.real(r.detuning_sq_lambda2);
    bytes.real(r.piezo_v);
    bytes.real(r.temperature_c);
    bytes.whole(r.bias_sign);
    bytes.whole(r.mode);
    bytes.whole(r.loop_closed);
    bytes.whole(r.valid);
    bytes.whole(r.edge_offset_ticks);
    bytes.whole(r.span);
    bytes.real(r.fringe);
    bytes.whole(r.lit);
    bytes.whole(r.coil_ua);
}

void put(HalfBytes& bytes, const twin::TwinTruth& t) {
    bytes.real(t.dtheta_arcsec);
    bytes.real(t.false_relock_arcsec);
    bytes.real(t.detuning_end_lambda);
    bytes.real(t.perimeter_v);
    bytes.real(t.rounding_arcsec);
    bytes.real(t.random_walk_arcsec);
    bytes.whole(t.lit);
}

}  // namespace

void Fingerprint::take(const LoopHalf& half, const core::SensorFrame& sensor) {
    HalfBytes bytes;
    put(bytes, sensor);
    put(bytes, half.control.actuator);
    put(bytes, half.record);
    put(bytes, half.truth);
    halves_ = bytes.hashed(halves_);
}

void Fingerprint::take(const core::AngleRow& row) {
    Bytes<48> bytes;
    bytes.whole(row.tick);
    bytes.real(row.dtheta_arcsec);
    bytes.real(row.dtheta_final_arcsec);
    bytes.real(row.sigma_arcsec);
    bytes.whole(row.mode);
    bytes.whole(row.flags);
    rows_ = bytes.hashed(rows_);
}

std::uint64_t Fingerprint::value() const {
    Bytes<16> bytes;
    bytes.word(halves_);
    bytes.word(rows_);
    return bytes.hashed(0);
}

std::string Fingerprint::text() const { return fmt::format("{:016x}", value()); }

}  // namespace zlg::rig
