#pragma once
// Half-period records for the tests of the whole compensation, and how they are run through it.

#include <zlg/core/gyro_compensation.hpp>

#include "compensation_support.hpp"

namespace gyro_compensation_support {

using namespace zlg::core;
using namespace compensation_test;

using Halves = std::vector<HalfRecord>;

struct Delivered {
    std::vector<CompensationOutput> samples;
    std::vector<AngleRow> rows;
    std::vector<GapReport> gaps;
};

inline void drain_into(const GyroCompensationConfig& config, GyroCompensationState& state, Delivered& result) {
    for (;;) {
        const zlg::core::DrainOutput out = drain(config, state);
        if (out.has_gap) result.gaps.push_back(out.gap);
        if (out.has_row) result.rows.push_back(out.row);
        if (!out.has_gap && !out.has_row) return;
    }
}

inline void step_into(const GyroCompensationConfig& config, GyroCompensationState& state, const HalfRecord& half,
                      Delivered& result) {
    const CompensationOutput out = step(config, state, half);
    if (!out.has_sample) return;
    result.samples.push_back(out);
    if (out.sample.has_final) result.rows.push_back(out.sample.final_row);
    if (out.sample.has_gap) result.gaps.push_back(out.sample.gap);
}

inline Delivered run(const GyroCompensationConfig& config, const Halves& halves) {
    GyroCompensationState state;
    Delivered result;
    for (const HalfRecord& half : halves) step_into(config, state, half, result);
    drain_into(config, state, result);
    return result;
}

// A bias of 150 counts a half, and a rotation; nothing else is measured.
inline Halves biased_halves(int n, std::int64_t rotation_counts = 0) {
    Halves halves;
    for (int k = 0; k < n; ++k) {
        const std::int8_t sign = k % 2 == 0 ? 1 : -1;
        HalfRecord half{.half = k, .counts = rotation_counts + 150 * sign, .bias_sign = sign};
        half.detuning_lambda = half.detuning_sq_lambda2 = half.piezo_v = half.temperature_c = not_a_number;
        halves.push_back(half);
    }
    return halves;
}

struct Sums {
    double delivered = 0.0, final = 0.0;
};

// Both sums, which must be equal at each correction.
inline Sums sums_of(const Delivered& all, bool alone = true) {
    Sums s;
    for (const AngleRow& row : all.rows) {
        s.delivered += row.dtheta_arcsec;
        s.final += row.dtheta_final_arcsec;
        if (alone && (row.flags & flag_correction) != 0) {
            EXPECT_NEAR(s.delivered, s.final, 1e-9) << row.tick;
        }
    }
    return s;
}

// As a control records halves first .. first + n - 1 that were missed.
inline void miss(Halves& halves, std::size_t first, std::size_t n) {
    HalfRecord& next = halves[first + n];
    for (std::size_t h = first; h < first + n; ++h) {
        next.counts += halves[h].counts;
        next.span += halves[h].span;
        halves[h].counts = 0;
        halves[h].span = 1;
        halves[h].valid = false;
    }
}

// What a gyro records: rotation and bias, summed exactly and read by a counter that truncates.
class Recorder {
public:
    Recorder(const GyroCompensationConfig& config, std::int8_t first_sign, std::int8_t mode)
        : config_{config}, first_sign_{first_sign}, mode_{mode} {}

    std::int8_t mode() const { return mode_; }
    void flip() { mode_ = static_cast<std::int8_t>(-mode_); }

    // One half with a rotation in arcsec and a mean square of the detuning that weakens the bias.
    HalfRecord half(double rotation_arcsec, double mean_square) {
        const auto& gyro = config_.gyro;
        HalfRecord record;
        record.half = next_++;
        record.bias_sign = static_cast<std::int8_t>(record.half % 2 == 0 ? first_sign_ : -first_sign_);
        record.mode = mode_;
        record.detuning_lambda = std::sqrt(mean_square);
        record.detuning_sq_lambda2 = mean_square;
        record.piezo_v = record.temperature_c = compensation_test::not_a_number;
        const double bias_hz = gyro.bias.value() * (1.0 - gyro.chi * mean_square);
        const auto before = static_cast<std::int64_t>(std::floor(counts_));
        counts_ +=
            rotation_arcsec / gyro.scale.value() + record.bias_sign * record.mode * bias_hz * 0.5 * gyro.tick.value();
        record.counts = static_cast<std::int64_t>(std::floor(counts_)) - before;
        return record;
    }

    void tick_into(Halves& halves, double rotation_arcsec, bool loop_closed = true) {
        for (int k = 0; k < 2; ++k) {
            halves.push_back(half(0.5 * rotation_arcsec, 0.0));
            halves.back().loop_closed = loop_closed;
        }
    }

private:
    GyroCompensationConfig config_;
    std::int8_t first_sign_;
    std::int8_t mode_;
    std::int64_t next_ = 0;
    double counts_ = 0.0;
};

}  // namespace gyro_compensation_support
