#pragma once
// One helicity of a gyro with backscatter, a trapezoidal bias and edges that may be dithered: what the tests of lock-in
// look at. Latched at the reversals, as the counter is.

#include <zlg/core/control/edge_dither.hpp>
#include <zlg/twin/beat_phase.hpp>

#include "slip_phase.hpp"
#include "test.hpp"

namespace zlg::twin {

struct LockInGyro {
    double scale_arcsec = 3.263;
    double tick_s = 0.005;
    double edge_s = 50e-6;
    double bias_hz = 60e3;  // of the plateau
    double lock_hz = 300.0;
    double origin_rad = 0.7;
    double rate_arcsec_s = 0.0;
    int helicity = 1;
    bool dithered = false;
    bool counts_only = false;  // the angle from whole counts, not from the phase
    bool by_slip_formula = false;
    double law_error = 0.0;  // of f0 in the dither's configuration
    std::uint64_t seed = 1;
    double start_turns = 0.1;
};

// Runs gyros tick by tick and tells the angle that the processor would read, known areas of the bias subtracted.
class LockInRun {
public:
    explicit LockInRun(const LockInGyro& g) : g_{g}, exact_{start(g)}, slip_{start(g)}, latched_{start(g)} {
        dither_.seed = g.seed;
        dither_.cycle_ticks = timer_hz / (g.bias_hz * (1.0 + g.law_error));
        dither_.tick_s = g.tick_s;
        dither_.scale_arcsec = g.scale_arcsec;
        coupling_ = Backscatter::equal(g.lock_hz, g.origin_rad).coupling(1.0, 1.0);
    }

    // One period: the angle read, arcsec.
    double tick() {
        const double first = half(+1);
        seen_first_ = seen_;
        return first + half(-1);
    }
    // The counts of its halves, with their parts.
    [[nodiscard]] double seen_first() const { return seen_first_; }
    [[nodiscard]] double seen_second() const { return seen_; }
    // n periods: the mean rate read, arcsec/s.
    double mean_rate(int n) {
        double sum = 0.0;
        for (int i = 0; i < n; ++i) sum += tick();
        return sum / (n * g_.tick_s);
    }
    [[nodiscard]] core::DitherLaw law() const { return state_.law; }

private:
    static constexpr double timer_hz = 1e7;

    static Turns start(const LockInGyro& g) {
        Turns t;
        t.add(g.start_turns);
        return t;
    }

    double half(int sign) {
        const double rate_hz = g_.rate_arcsec_s / g_.scale_arcsec;
        const std::int32_t excess = sign * (state_.end_ticks - state_.start_ticks);
        const double length_s = 0.5 * g_.tick_s + sign * excess / timer_hz;
        const double plateau_hz = rate_hz + sign * g_.helicity * g_.bias_hz;
        const double plateau_s = length_s - g_.edge_s;
        const double after_hz = rate_hz - sign * g_.helicity * g_.bias_hz;

        const Turns before = latched_;
        if (g_.by_slip_formula) {
            slip_.plateau(plateau_hz, coupling_, plateau_s);
            latched_ = slip_.reversal(plateau_hz, after_hz, coupling_, g_.edge_s);
        } else {
            exact_.advance(rate_hz, plateau_hz, coupling_, 0.5 * g_.edge_s);
            exact_.plateau(plateau_hz, coupling_, plateau_s);
            exact_.advance(plateau_hz, rate_hz, coupling_, 0.5 * g_.edge_s);
            latched_ = exact_.value();
        }
        const std::int64_t counts = latched_.whole - before.whole;
        if (g_.dithered) {
            const core::RateReading reading{true, counts, static_cast<std::int8_t>(g_.helicity)};
            (void)core::step(dither_, state_, static_cast<std::int8_t>(-sign), reading);
        }
        seen_ = g_.counts_only ? static_cast<double>(counts) : latched_.minus(before);
        const double bias = sign * g_.helicity * g_.bias_hz * (0.5 * g_.tick_s - 0.5 * g_.edge_s) +
                            g_.helicity * g_.bias_hz * excess / timer_hz;
        // The latch moves with the edge: of the rotation meanwhile the nominal half is wanted.
        return g_.scale_arcsec * (seen_ - bias) - g_.rate_arcsec_s * (length_s - 0.5 * g_.tick_s);
    }

    LockInGyro g_;
    Coupling coupling_;
    BeatPhase exact_;
    SlipPhase slip_;
    Turns latched_;
    core::EdgeDitherConfig dither_;
    core::EdgeDitherState state_;
    double seen_ = 0.0, seen_first_ = 0.0;
};

}  // namespace zlg::twin
