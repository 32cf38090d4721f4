#include <zlg/core/compensation/field_step.hpp>

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Length of the first blocks, in seconds.
constexpr double block_s = 0.1;

// Standard deviations by which a rate must step, and (1) be away from 0; and within which (1) agrees with a value.
constexpr double min_sigmas_sq = 25.0;
constexpr double agreement_sq = 9.0;

// Least blocks on either side of a step.
constexpr int min_side = 1;

// Blocks of one length; a step is agreed on by both ways to see it within this part of itself, too.
constexpr int most_alike = 7;
constexpr double agreement_ratio = 0.25;

constexpr double first_look_s = 1.0;  // after the re-lock: from here
constexpr double last_look_s = 4.0;   // to here it is decided

// Gain a tick of what the past lacks: of 98 arcsec 0.4 come in the first tick.
constexpr double past_gain = 1.0 / 256.0;

// Variance by which the drift may change from switch to switch: warming.
constexpr double drift_noise = 0.01;

double reading_arcsec2(const CompensationConstants& g, bool with_phase) noexcept {
    const double count = g.scale.value();
    return with_phase ? square(count * g.fringe_noise_counts) : count * count / 12.0;
}

// Variance of a mean rate over so many ticks: two readings, and the walk.
double rate_variance(const CompensationConstants& g, double n_ticks, bool with_phase) noexcept {
    const double length_s = n_ticks * g.tick.value();
    const double walk = g.random_walk.value();
    return 2.0 * reading_arcsec2(g, with_phase) / square(length_s) + walk * walk / length_s;
}

// Of a mean rate, by motion like that of the segment: slow motion counts in full, however long the stretch is.
double motion_variance(const SegmentStep& segment, double length_s) noexcept {
    return segment.slow_motion + 2.0 * segment.fast_motion / square(length_s);
}

void merge(SegmentBlocks& b, int first) noexcept {
    const auto k = static_cast<unsigned>(first);
    b.block[k].n_ticks += b.block[k + 1].n_ticks;
    b.block[k].arcsec += b.block[k + 1].arcsec;
    --b.n;
    for (auto j = k + 1; j < static_cast<unsigned>(b.n); ++j) b.block[j] = b.block[j + 1];
}

// Of more than `most_alike` blocks of one length the two oldest become one of twice that.
void thin_out(SegmentBlocks& b) noexcept {
    for (int end = b.n; end > 0;) {
        const std::int64_t length = b.block[static_cast<unsigned>(end - 1)].n_ticks;
        int begin = end - 1;
        while (begin > 0 && b.block[static_cast<unsigned>(begin - 1)].n_ticks == length) --begin;
        if (end - begin <= most_alike) break;
        merge(b, begin);
        end = begin + 1;
    }
    if (b.n == field_blocks) merge(b, 0);
}

// Sums over some blocks, of x the angle and n the ticks.
struct BlockSums {
    double x = 0.0, n = 0.0, xx = 0.0, xn = 0.0, nn = 0.0;

    void add(const SegmentBlock& block, double rate, double sign) noexcept {
        const double ticks = as_double(block.n_ticks);
        const double angle = block.arcsec - rate * ticks;
        x += sign * angle;
        n += sign * ticks;
        xx += sign * angle * angle;
        xn += sign * angle * ticks;
        nn += sign * ticks * ticks;
    }
    // Sum of (x - n mean)^2.
    [[nodiscard]] double residual() const noexcept {
        const double mean = x / n;
        return xx - mean * (2.0 * xn - mean * nn);
    }
};

// The two parts of a segment beside the block in which a step falls.
struct Cut {
    int at = 0;  // that block; 0: there is none
    BlockSums before{}, after{};
    double residual = infinity;
};

// Less the rate of the first block, so that squares stay small.
double first_rate(const SegmentBlocks& b) noexcept { return b.block[0].arcsec / as_double(b.block[0].n_ticks); }

Cut best_cut(const SegmentBlocks& b) noexcept {
    const double rate = first_rate(b);
    Cut best;
    BlockSums before;
    BlockSums after;
    for (int k = 0; k < b.n; ++k) after.add(b.block[static_cast<unsigned>(k)], rate, 1.0);
    for (int k = 0; k < b.n - min_side; ++k) {
        const SegmentBlock& block = b.block[static_cast<unsigned>(k)];
        after.add(block, rate, -1.0);
        if (k >= min_side) {
            const double residual = before.residual() + after.residual();
            if (residual < best.residual) best = {.at = k, .before = before, .after = after, .residual = residual};
        }
        before.add(block, rate, 1.0);
    }
    return best;
}

// Of whole blocks.
SegmentBlock whole(const SegmentBlocks& b) noexcept {
    SegmentBlock sum;
    for (int k = 0; k < b.n; ++k) {
        sum.n_ticks += b.block[static_cast<unsigned>(k)].n_ticks;
        sum.arcsec += b.block[static_cast<unsigned>(k)].arcsec;
    }
    return sum;
}

// The step of the drift, of (1) and of the segment, by their variances.
void tell(const CompensationConstants& g, FieldStepState& s, double by_jump, double jump_variance) noexcept {
    const SegmentStep& b = s.before;
    const double mode_before = -static_cast<double>(s.mode);
    const double step_variance = b.rate_variance + b.before_variance;
    const double variance = step_variance * jump_variance / (step_variance + jump_variance);
    const double d = variance * (mode_before * b.step_arcsec_s / step_variance + by_jump / jump_variance);
    s.drift_arcsec_s += d;
    s.drift_variance += variance;
    // What came unseen has gone.
    if (size(s.unseen_arcsec_s + d) < 0.5 * size(s.unseen_arcsec_s)) {
        s.unseen_arcsec_s = 0.0;
        return;
    }
    s.waiting_arcsec += b.excess_arcsec - mode_before * d * as_double(s.n_ticks) * g.tick.value();
    s.waiting_arcsec2 += b.excess_variance;
    s.field_arcsec_s += d;
    s.change_variance = variance;
}

// Without a step: a better mean of the drift; after a switch that was left open, of the field in it.
void follow(FieldStepState& s, double nu, double variance) noexcept {
    const double gain = s.drift_variance / variance;
    s.drift_arcsec_s += gain * nu;
    s.drift_variance -= gain * s.drift_variance;
    if (!s.is_open) return;
    // The moment at which this came is unknown.
    if (s.field_arcsec_s != 0.0) {
        s.field_arcsec_s += gain * nu;
        s.change_variance = square(gain * nu);
    } else {
        s.unseen_arcsec_s += gain * nu;
    }
    s.is_open = false;
}

// It remains unknown what happened. The drift may be another one, and the angle since the step no rotation.
void leave_open(FieldStepState& s, double nu) noexcept {
    s.drift_variance += nu * nu;
    s.is_open = true;
    if (s.before.stepped) s.waiting_arcsec2 += square(s.before.excess_arcsec);
    if (s.field_arcsec_s != 0.0) s.waiting_arcsec2 += square(nu * s.before.length_s);
}

// last  it is now or never.
void decide(const CompensationConstants& g, const FieldStepPrior& prior, FieldStepState& s, bool with_phase,
            bool last) noexcept {
    const SegmentBlock now = whole(s.blocks);
    const SegmentStep& b = s.before;
    const double rate = now.arcsec / (as_double(now.n_ticks) * g.tick.value());
    const double rate_noise = rate_variance(g, as_double(now.n_ticks), with_phase) + square(prior.sway_arcsec_s) +
                              motion_variance(b, as_double(now.n_ticks) * g.tick.value());
    const double mode_before = -static_cast<double>(s.mode);
    const double nu = 0.5 * mode_before * (b.rate_arcsec_s - rate) - s.drift_arcsec_s;
    const double variance = 0.25 * (b.rate_variance + rate_noise) + s.drift_variance;
    const double off = nu - mode_before * b.step_arcsec_s;
    const bool is_zero = nu * nu < agreement_sq * variance;
    const bool is_step = b.stepped && off * off < agreement_sq * (variance + b.before_variance) &&
                         size(off) < agreement_ratio * size(b.step_arcsec_s);
    if (is_step && nu * nu > min_sigmas_sq * variance) {
        tell(g, s, nu, variance);
    } else if (is_zero && !is_step) {
        follow(s, nu, variance);
    } else if (last) {
        leave_open(s, nu);
    } else {
        return;
    }
    s.waits = false;
}

// The segment is over; the tick of the next one comes after this.
void end_segment(const CompensationConstants& g, const FieldStepPrior& prior, FieldStepState& s,
                 const FieldStepTick& tick) noexcept {
    if (s.waits && s.blocks.n >= min_side) decide(g, prior, s, tick.with_phase, true);
    s.before = s.paused ? s.finished : step_of(g, s.blocks, tick.with_phase, prior.sway_arcsec_s);
    s.waits = s.before.known;
    s.blocks = {};
    s.n_ticks = 0;
    s.drift_variance += drift_noise;
    s.mode = tick.mode;
}

}  // namespace

bool accumulate(const CompensationConstants& gyro, SegmentBlocks& blocks, double angle_arcsec) noexcept {
    blocks.growing.arcsec += angle_arcsec;
    ++blocks.growing.n_ticks;
    if (as_double(blocks.growing.n_ticks) * gyro.tick.value() < block_s) return false;
    blocks.block[static_cast<unsigned>(blocks.n++)] = blocks.growing;
    blocks.growing = {};
    thin_out(blocks);
    return true;
}

SegmentStep step_of(const CompensationConstants& g, const SegmentBlocks& b, bool with_phase,
                    double sway_arcsec_s) noexcept {
    SegmentStep out;
    if (b.n < min_side) return out;
    const double tick_s = g.tick.value();
    const double sway = square(sway_arcsec_s);
    const SegmentBlock all = whole(b);
    out.known = true;
    out.length_s = as_double(all.n_ticks) * tick_s;
    out.rate_arcsec_s = all.arcsec / (as_double(all.n_ticks) * tick_s);
    out.rate_variance = rate_variance(g, as_double(all.n_ticks), with_phase) + sway;
    const Cut cut = best_cut(b);
    if (cut.at == 0) return out;
    const double nn = cut.before.nn + cut.after.nn;
    const double usual =
        (b.n - 1) * 2.0 * reading_arcsec2(g, with_phase) + walk_arcsec2(g) * (cut.before.n + cut.after.n);
    const double beyond = cut.residual > 2.0 * usual ? cut.residual - 2.0 * usual : 0.0;
    out.slow_motion = beyond / (nn * tick_s * tick_s);
    out.fast_motion = beyond / static_cast<double>(b.n - 1);
    const double before_variance =
        rate_variance(g, cut.before.n, with_phase) + sway + motion_variance(out, cut.before.n * tick_s);
    const double after_variance =
        rate_variance(g, cut.after.n, with_phase) + sway + motion_variance(out, cut.after.n * tick_s);
    const double before = cut.before.x / cut.before.n;
    const double step = (cut.after.x / cut.after.n - before) / tick_s;
    if (!(step * step > min_sigmas_sq * (after_variance + before_variance))) {
        out.rate_variance += motion_variance(out, out.length_s);
        return out;
    }
    out.stepped = true;
    const double rate = first_rate(b);
    out.rate_arcsec_s = (cut.after.x / cut.after.n + rate) / tick_s;
    out.rate_variance = after_variance;
    out.step_arcsec_s = step;
    out.before_variance = before_variance;
    const SegmentBlock& cut_block = b.block[static_cast<unsigned>(cut.at)];
    const double n_since = cut.after.n + as_double(cut_block.n_ticks + b.growing.n_ticks);
    const double arcsec_since = cut.after.x + rate * cut.after.n + cut_block.arcsec + b.growing.arcsec;
    out.excess_arcsec = arcsec_since - (before + rate) * n_since;
    out.excess_variance = square(n_since * tick_s) * before_variance + 2.0 * reading_arcsec2(g, with_phase);
    return out;
}

bool pause(const CompensationConstants& gyro, const FieldStepPrior& prior, FieldStepState& state,
           bool with_phase) noexcept {
    if (!state.paused) state.finished = step_of(gyro, state.blocks, with_phase, prior.sway_arcsec_s);
    state.paused = true;
    return state.finished.stepped;
}

FieldStepOutput step(const CompensationConstants& gyro, const FieldStepPrior& prior, FieldStepState& state,
                     const FieldStepTick& tick) noexcept {
    if (state.drift_variance == 0.0) {
        state.drift_arcsec_s = prior.drift_arcsec_s;
        state.drift_variance = prior.drift_variance + drift_noise;
    }
    state.change_variance = 0.0;
    if (tick.mode != state.mode) end_segment(gyro, prior, state, tick);
    state.paused = false;
    if (tick.settled && accumulate(gyro, state.blocks, tick.angle_arcsec) && state.waits) {
        const double looked = as_double(whole(state.blocks).n_ticks) * gyro.tick.value();
        if (looked >= first_look_s) decide(gyro, prior, state, tick.with_phase, looked >= last_look_s);
    }
    ++state.n_ticks;
    const double past = past_gain * state.waiting_arcsec;
    const double past_arcsec2 = past_gain * state.waiting_arcsec2;
    state.waiting_arcsec -= past;
    state.waiting_arcsec2 -= past_arcsec2;
    return {.subtract_arcsec = static_cast<double>(tick.mode) * state.field_arcsec_s * gyro.tick.value() + past,
            .variance_arcsec2 = past_arcsec2};
}

}  // namespace zlg::core
