#include <zlg/rig/fingerprint.hpp>

#include <bit>
#include <cstring>
#include <span>

#include <fmt/format.h>

// The hash is part of this source alone: no library has to be there where the program runs.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace zlg::rig {
namespace {

// Writes numbers as bytes, the lowest first, whatever the order of the machine.
class Bytes {
public:
    explicit Bytes(std::span<unsigned char> room) : byte_{room.data()} {}

    template <class Word> void word(Word value) {
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
        // As whole numbers, which the processor compares many at once: behind infinity there are only those that are
        // none.
        std::uint32_t n_none = 0;
        for (const float value : values) n_none += (std::bit_cast<std::uint32_t>(value) & 0x7fff'ffffu) > 0x7f80'0000u;
        if (is_in_order && n_none == 0) {
            std::memcpy(&byte_[size_], values.data(), values.size_bytes());
            size_ += values.size_bytes();
            return;
        }
        for (const float value : values) real(value);
    }

    [[nodiscard]] std::size_t size() const { return size_; }

private:
    static constexpr bool is_in_order = std::endian::native == std::endian::little;

    unsigned char* byte_;
    std::size_t size_ = 0;
};

void put(Bytes& bytes, const core::SensorFrame& s) {
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

void put(Bytes& bytes, const core::ActuatorFrame& a) {
    bytes.whole(a.loop_closed);
    bytes.whole(a.polarity);
    bytes.whole(a.n_set_points);
    for (const double v : std::span{a.set_point_v}.first(a.n_set_points)) bytes.real(v);
    bytes.whole(a.edge_offset_ticks);
}

void put(Bytes& bytes, const core::HalfRecord& r) {
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
    bytes.whole(0);  // where records had the current of the coil: a run has the fingerprint that it ever had
}

void put(Bytes& bytes, const twin::TwinTruth& t) {
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
    before_last_ = halves();
    Bytes bytes{last_half_};
    put(bytes, sensor);
    put(bytes, half.control.actuator);
    put(bytes, half.record);
    put(bytes, half.truth);
    n_last_half_ = bytes.size();
}

void Fingerprint::take(const Leap& leap) {
    before_last_ = halves();
    Bytes bytes{last_half_};
    bytes.whole(leap.halves);
    bytes.whole(leap.counts);
    bytes.whole(leap.parts);
    for (const double x : {leap.dtheta_arcsec, leap.turned_counts, leap.rounding_arcsec, leap.set_point_v,
                           leap.temperature_c, leap.bias_ratio, leap.light_after[0], leap.light_after[1]})
        bytes.real(x);
    n_last_half_ = bytes.size();
}

void Fingerprint::take(const core::AngleRow& row) {
    std::array<unsigned char, 48> room;
    Bytes bytes{room};
    bytes.whole(row.tick);
    bytes.real(row.dtheta_arcsec);
    bytes.real(row.dtheta_final_arcsec);
    bytes.real(row.sigma_arcsec);
    bytes.whole(row.mode);
    bytes.whole(row.flags);
    rows_ = XXH64(room.data(), bytes.size(), rows_);
}

std::uint64_t Fingerprint::halves() const {
    return n_last_half_ == 0 ? before_last_ : XXH64(last_half_.data(), n_last_half_, before_last_);
}

std::uint64_t Fingerprint::value() const {
    std::array<unsigned char, 16> room;
    Bytes bytes{room};
    bytes.word(halves());
    bytes.word(rows_);
    return XXH64(room.data(), bytes.size(), 0);
}

std::string Fingerprint::text() const { return fmt::format("{:016x}", value()); }

}  // namespace zlg::rig
