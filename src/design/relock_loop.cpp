#include <zlg/design/relock_loop.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "range_check.hpp"

namespace zlg::design {
namespace {

constexpr std::string_view where = "re-lock loop";

void check(const RelockLoop& loop, double miss_lambda, int n_ticks) {
    require_positive(where, "tick_s", loop.tick_s);
    require_positive(where, "tau_s", loop.tau_s);
    require(loop.limit_lambda > 0.0, where, "limit_lambda", loop.limit_lambda, "a number above 0, or infinity");
    require_not_negative(where, "rc_s", loop.rc_s);
    require(loop.slew_lambda_s > 0.0, where, "slew_lambda_s", loop.slew_lambda_s, "a number above 0, or infinity");
    require(std::abs(miss_lambda) <= 0.5, where, "miss_lambda", miss_lambda, "-0.5..0.5");
    require(n_ticks >= 1 && n_ticks <= 10000, where, "n_ticks", n_ticks, "1..10000");
}

void check(const BiasLaw& law) {
    require_positive("bias law", "scale_arcsec", law.scale_arcsec);
    require_positive("bias law", "bias_hz", law.bias_hz);
    require(std::isfinite(law.chi), "bias law", "chi", law.chi, "a number");
}

// Integrals of dl and dl^2 travel with the state, so the means over a half are as exact as the motion.
enum Member : std::size_t { command, voltage, sum, sum_square, n_members };
using State = std::array<double, n_members>;

State advanced(const State& s, const State& slope, double by) {
    State next;
    for (std::size_t k = 0; k < n_members; ++k) next[k] = s[k] + by * slope[k];
    return next;
}

// Of a half. Classical Runge-Kutta of fourth order loses its order at the corners that limiter and slew put inside a
// step, so that short simulations have 4000 steps a tick; from 1000 ticks on fewer, down to 1000, bound the cost. A
// time constant is parted into 100 steps or more.
double steps_a_half(const RelockLoop& loop, int n_ticks) {
    constexpr double long_ticks = 1000.0;
    const double grid = 4000.0 / std::max(1.0, n_ticks / long_ticks);
    double step = std::min(loop.tick_s / std::max(1000.0, grid), loop.tau_s / 200.0);
    if (loop.rc_s > 0.0) step = std::min(step, loop.rc_s / 100.0);
    return std::ceil(0.5 * loop.tick_s / step);
}

class Simulation {
public:
    Simulation(const RelockLoop& loop, double miss_lambda, int n_ticks) : loop_{loop}, miss_{miss_lambda} {
        const double steps = steps_a_half(loop, n_ticks);
        require(steps <= 1e6, where, "steps a half", steps, "at most 1e6: a time constant is too short for the tick");
        steps_a_half_ = static_cast<int>(steps);
        step_s_ = 0.5 * loop.tick_s / steps_a_half_;
    }

    RelockTrace run(int n_ticks) {
        trace_.step_s = step_s_;
        trace_.detuning_lambda = {detuning(state_)};
        for (int half = 0; half < 2 * n_ticks; ++half) {
            const State before = state_;
            for (int k = 0; k < steps_a_half_; ++k) step();
            const double length = 0.5 * loop_.tick_s;
            trace_.half.push_back(
                {(state_[sum] - before[sum]) / length, (state_[sum_square] - before[sum_square]) / length});
        }
        return std::move(trace_);
    }

private:
    [[nodiscard]] double detuning(const State& s) const { return miss_ - (loop_.rc_s > 0.0 ? s[voltage] : s[command]); }

    [[nodiscard]] State slope(const State& s) const {
        State d{};
        d[command] = std::clamp(detuning(s), -loop_.limit_lambda, loop_.limit_lambda) / loop_.tau_s;
        if (loop_.rc_s > 0.0) {
            d[voltage] = std::clamp((s[command] - s[voltage]) / loop_.rc_s, -loop_.slew_lambda_s, loop_.slew_lambda_s);
        }
        d[sum] = detuning(s);
        d[sum_square] = d[sum] * d[sum];
        return d;
    }

    void step() {
        const State a = slope(state_);
        const State b = slope(advanced(state_, a, 0.5 * step_s_));
        const State c = slope(advanced(state_, b, 0.5 * step_s_));
        const State d = slope(advanced(state_, c, step_s_));
        for (std::size_t k = 0; k < n_members; ++k) {
            state_[k] += step_s_ / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
        }
        trace_.detuning_lambda.push_back(detuning(state_));
    }

    RelockLoop loop_;
    double miss_;
    int steps_a_half_ = 0;
    double step_s_ = 0.0;
    State state_{};
    RelockTrace trace_;
};

}  // namespace

RelockTrace simulate_relock(const RelockLoop& loop, double miss_lambda, int n_ticks) {
    check(loop, miss_lambda, n_ticks);
    return Simulation{loop, miss_lambda, n_ticks}.run(n_ticks);
}

double relock_time_s(const RelockLoop& loop, double miss_lambda, double tolerance_lambda, int n_ticks) {
    return relock_time_s(simulate_relock(loop, miss_lambda, n_ticks), tolerance_lambda);
}

double relock_steps(const RelockLoop& loop, int n_ticks) { return 2.0 * n_ticks * steps_a_half(loop, n_ticks); }

double relock_time_s(const RelockTrace& trace, double tolerance_lambda) {
    require_positive(where, "tolerance_lambda", tolerance_lambda);
    const auto& dl = trace.detuning_lambda;
    std::size_t k = dl.size();
    while (k > 0 && std::abs(dl[k - 1]) <= tolerance_lambda) --k;
    if (k == 0) return 0.0;
    if (k == dl.size()) return std::numeric_limits<double>::infinity();
    const double outside = std::abs(dl[k - 1]);
    const double inside = std::abs(dl[k]);
    return trace.step_s * (static_cast<double>(k - 1) + (outside - tolerance_lambda) / (outside - inside));
}

double bias_deficit_arcsec_s(const BiasLaw& law, double detuning_lambda) {
    check(law);
    require_finite("bias law", "detuning_lambda", detuning_lambda);
    return law.scale_arcsec * law.bias_hz * law.chi * detuning_lambda * detuning_lambda;
}

std::vector<double> false_drift_arcsec_s(const BiasLaw& law, const RelockTrace& trace, int first_sign) {
    check(law);
    require(first_sign == 1 || first_sign == -1, "false drift", "first_sign", first_sign, "1 or -1");
    const double gain = 0.5 * first_sign * law.scale_arcsec * law.bias_hz * law.chi;
    std::vector<double> drift;
    for (std::size_t h = 0; h + 1 < trace.half.size(); h += 2) {
        drift.push_back(gain * (trace.half[h + 1].mean_square_lambda2 - trace.half[h].mean_square_lambda2));
    }
    return drift;
}

double false_angle_law_arcsec(double deficit_arcsec_s, double tick_s) {
    require(std::isfinite(deficit_arcsec_s), "false angle", "deficit_arcsec_s", deficit_arcsec_s, "a number");
    require_positive("false angle", "tick_s", tick_s);
    return 0.25 * tick_s * deficit_arcsec_s;
}

}  // namespace zlg::design
