// Compensation of any records with any configuration that passed `check`: nothing that comes out is not a number, every
// tick gets its final row in time, no angle is lost, and a copy of the state goes on like the original.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <zlg/core/gyro_compensation.hpp>

#include "bytes.hpp"
#include "claim.hpp"

namespace {

using namespace zlg::core;
using zlg::fuzz::Bytes;
using zlg::fuzz::claim;

constexpr int max_delay_ticks = zlg::core::most_final_delay_ticks;

void constants_from(Bytes& bytes, CompensationConstants& c) {
    c.tick = Seconds{bytes.real(0.005)};
    c.scale = Arcsec{bytes.real(3.263)};
    c.bias = Hertz{bytes.real(60e3)};
    c.chi = bytes.real(3.6);
    c.temperature_coefficient_per_c = bytes.real(1e-4);
    c.reference_temperature = Celsius{bytes.real(20.0)};
    c.light_noise = Wavelengths{bytes.real(0.0033)};
    c.light_samples = bytes.take<std::int8_t>();
}

GyroCompensationConfig config_from(Bytes& bytes) {
    GyroCompensationConfig c;
    c.relock.method = static_cast<RelockMethod>(bytes.index(5));
    c.relock.ticks = bytes.flag() ? 20 : bytes.take<std::int8_t>();
    // The rest is as it is mostly, so that most inputs are about the records.
    if (!bytes.flag()) constants_from(bytes, c.gyro);
    c.bridge.method = static_cast<BridgeMethod>(bytes.index(5));
    c.bridge.extrapolation_points = static_cast<int>(bytes.index(10));
    c.bridge.points_before = static_cast<int>(bytes.index(10));
    c.bridge.points_after = static_cast<int>(bytes.index(10));
    if (bytes.flag()) c.gyro.timer = Hertz{bytes.real(1e7)};
    if (bytes.flag()) c.gyro.random_walk = ArcsecPerRootSecond{bytes.real(0.14)};
    c.magnetic.method = static_cast<MagneticMethod>(bytes.index(3));
    if (bytes.flag()) c.lock_in = {.threshold = Hertz{bytes.real(150.0)}, .sigma = Hertz{bytes.real(300.0)}};
    return c;
}

// Most halves are a byte: what the gyro did. Some are of any bits.
HalfRecord half_from(Bytes& bytes, const HalfRecord& previous) {
    const auto what = bytes.take<std::uint8_t>();
    HalfRecord half;
    half.half = previous.half + 1;
    half.bias_sign = static_cast<std::int8_t>(-previous.bias_sign);
    half.mode = (what & 4) != 0 ? static_cast<std::int8_t>(-previous.mode) : previous.mode;
    half.loop_closed = (what & 3) != 3;
    half.valid = (what & 0x78) != 0x78;
    half.counts = 150 * half.bias_sign * half.mode + (what >> 4);
    half.detuning_lambda = 0.9 * previous.detuning_lambda;
    half.detuning_sq_lambda2 = 0.81 * previous.detuning_sq_lambda2;
    half.temperature_c = previous.temperature_c;
    half.lit = !half.loop_closed && (what & 0x10) != 0;
    if ((what & 0x80) == 0) return half;
    half.detuning_lambda = bytes.real(0.22);
    half.detuning_sq_lambda2 = bytes.real(0.0484);
    if (!bytes.flag()) return half;
    half.counts = bytes.take<std::int64_t>() >> bytes.index(64);
    half.temperature_c = bytes.real(20.0);
    half.edge_offset_ticks = bytes.take<std::int32_t>() >> bytes.index(32);
    half.bias_sign = bytes.take<std::int8_t>();
    half.mode = bytes.take<std::int8_t>();
    half.span = bytes.take<std::int32_t>() >> bytes.index(32);
    return half;
}

// The light of a half whose detuning falls, as the linear law reads it; some samples are of any bits.
class Light {
public:
    explicit Light(Bytes& bytes) : n_{bytes.index(80) - 8}, has_b_{bytes.flag()} {}

    LightSamples of(Bytes& bytes, double detuning_lambda) {
        if (n_ > a_.size()) return {};
        for (std::size_t k = 0; k < n_; ++k) {
            const double fallen = detuning_lambda * (1.0 - 0.1 * static_cast<double>(k) / static_cast<double>(n_));
            a_[k] = static_cast<float>(0.5 + fallen);
            b_[k] = static_cast<float>(0.5 - fallen);
        }
        if (detuning_lambda > 0.2 && bytes.flag()) a_[bytes.index(64)] = static_cast<float>(bytes.real(0.5));
        return {std::span{a_}.first(n_), std::span{b_}.first(has_b_ ? n_ : 0)};
    }

private:
    std::size_t n_;  // beyond 64: no light
    bool has_b_;
    std::array<float, 64> a_{};
    std::array<float, 64> b_{};
};

// What came out so far.
struct Ledger {
    std::int64_t n_ticks = 0;
    std::int64_t n_final = 0;
    std::int64_t last_gap_tick = -1;
    ExactSum delivered_arcsec{};
    ExactSum final_arcsec{};
    double largest_arcsec = 0.0;

    void note(double angle_arcsec) { largest_arcsec = std::fmax(largest_arcsec, std::fabs(angle_arcsec)); }

    void take(const AngleRow& row) {
        claim(row.tick == n_final++, "final rows come in order");
        claim(std::isfinite(row.dtheta_arcsec), "dtheta is a number");
        claim(std::isfinite(row.dtheta_final_arcsec), "final dtheta is a number");
        claim(std::isfinite(row.relock_arcsec), "the false angle is a number");
        claim(row.sigma_arcsec >= 0.0, "sigma is 0 or more");
        claim(row.mode == 1 || row.mode == -1, "mode is a sign");
        claim(row.flags < (1u << angle_flag_names.size()), "every flag has a name");
        note(row.dtheta_final_arcsec);
        final_arcsec.add(row.dtheta_final_arcsec);
    }

    void take(const GapReport& gap) {
        claim(gap.first_tick > last_gap_tick, "gaps are reported once and in order");
        claim(gap.n_ticks >= 1, "a gap has ticks");
        claim(std::isfinite(gap.dp_arcsec), "dP is a number");
        claim(gap.sigma_sum_arcsec >= 0.0, "sigma of a gap is 0 or more");
        last_gap_tick = gap.first_tick;
    }

    void take(const GyroCompensationConfig& config, const CompensationOutput& out) {
        const AngleSample& sample = out.sample;
        claim(sample.tick == n_ticks++, "ticks come in order");
        claim(std::isfinite(sample.dtheta_arcsec), "what is delivered is a number");
        claim(std::isfinite(out.angle_arcsec), "the angle is a number");
        const int delay = final_delay_ticks(config.gyro, bridge_of(config));
        claim(delay >= 0 && delay <= max_delay_ticks, "the delay is bounded");
        claim(sample.has_final == (sample.tick >= delay), "a tick is final after the delay");
        note(sample.dtheta_arcsec);
        delivered_arcsec.add(sample.dtheta_arcsec);
        if (sample.has_gap) take(sample.gap);
        if (sample.has_final) take(sample.final_row);
    }

    [[nodiscard]] bool sums_agree() const {
        const double difference_arcsec =
            (delivered_arcsec.high - final_arcsec.high) + (delivered_arcsec.low - final_arcsec.low);
        return std::fabs(difference_arcsec) <= 1e-9 + 0x1p-50 * largest_arcsec;
    }
};

// To the end of the log; the state is a copy.
void drain_all(const GyroCompensationConfig& config, GyroCompensationState state, Ledger& ledger) {
    constexpr int most = max_delay_ticks + max_pending_gaps;
    for (int n = 0;; ++n) {
        const DrainOutput out = drain(config, state);
        if (out.has_gap) ledger.take(out.gap);
        if (out.has_row) ledger.take(out.row);
        if (!out.has_gap && !out.has_row) break;
        claim(n <= most, "the drain ends");
    }
    claim(ledger.n_final == ledger.n_ticks, "every tick has a final row");
}

bool nothing_is_owed(const GyroCompensationState& s) {
    return s.bridge.n_pending == 0 && !s.bridge.gap.open && !s.first_waits;
}

bool same(const CompensationOutput& a, const CompensationOutput& b) {
    return a.has_sample == b.has_sample && same_bits(a.angle_arcsec, b.angle_arcsec) &&
           same_bits(a.sample.dtheta_arcsec, b.sample.dtheta_arcsec) && a.sample.tick == b.sample.tick &&
           a.sample.flags == b.sample.flags && a.sample.has_final == b.sample.has_final &&
           a.sample.final_row == b.sample.final_row && a.sample.has_gap == b.sample.has_gap &&
           a.sample.gap == b.sample.gap;
}

void run(const GyroCompensationConfig& config, Bytes& bytes) {
    GyroCompensationState state;
    std::optional<GyroCompensationState> snapshot;
    const unsigned snapshot_at = bytes.take<std::uint8_t>();
    Light lights{bytes};
    Ledger ledger;
    HalfRecord half{.half = -1, .detuning_lambda = 0.22, .detuning_sq_lambda2 = 0.0484, .temperature_c = 20.0};
    for (unsigned k = 0; !bytes.empty(); ++k) {
        half = half_from(bytes, half);
        if (k == snapshot_at) snapshot = state;
        const LightSamples light = lights.of(bytes, half.detuning_lambda);
        const CompensationOutput out = step(config, state, half, light);
        if (snapshot) {
            claim(same(step(config, *snapshot, half, light), out), "a copy gives the same bits");
            claim(*snapshot == state, "a copy stays equal");
        }
        if (!out.has_sample) continue;
        ledger.take(config, out);
        if ((out.sample.flags & flag_correction) == 0 || !nothing_is_owed(state)) continue;
        Ledger now = ledger;
        drain_all(config, state, now);
        claim(now.sums_agree(), "after a correction nothing of the angle is missing");
    }
    const bool settled = nothing_is_owed(state);
    drain_all(config, state, ledger);
    claim(!settled || ledger.sums_agree(), "at the end nothing of the angle is missing");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes{data, size};
    const GyroCompensationConfig config = config_from(bytes);
    if (check(config) == GyroCompensationFault::none) run(config, bytes);
    return 0;
}
