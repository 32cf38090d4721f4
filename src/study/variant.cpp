#include <zlg/study/variant.hpp>

#include <algorithm>
#include <cmath>

namespace zlg::study {

std::optional<SwitchStatistics> statistics(const std::vector<SwitchError>& errors) {
    SwitchStatistics s;
    double sum_sq = 0.0;
    double n = 0.0;
    for (const SwitchError& e : errors) {
        if (e.unrepaired) continue;
        n += 1.0;
        s.mean_arcsec += e.window.sign_after * e.error_arcsec;
        sum_sq += e.error_arcsec * e.error_arcsec;
        s.max_arcsec = std::max(s.max_arcsec, std::abs(e.error_arcsec));
    }
    if (n == 0.0) return std::nullopt;
    s.mean_arcsec /= n;
    s.rms_arcsec = std::sqrt(sum_sq / n);
    return s;
}

void Drift::add(double t_s, double error_arcsec) {
    n_ += 1.0;
    const double dt = t_s - mean_t_;
    mean_t_ += dt / n_;
    mean_e_ += (error_arcsec - mean_e_) / n_;
    tt_ += dt * (t_s - mean_t_);
    te_ += dt * (error_arcsec - mean_e_);
}

// Sums of squares of two sets about their common means (Chan, Golub and LeVeque, 1979).
void Drift::add(double n, double step_s, double t_s, double from_arcsec, double error_arcsec) {
    const double step_arcsec = (error_arcsec - from_arcsec) / n;
    const double own = n * (n * n - 1.0) / 12.0;
    const double dt = t_s - 0.5 * (n - 1.0) * step_s - mean_t_;
    const double de = error_arcsec - 0.5 * (n - 1.0) * step_arcsec - mean_e_;
    const double part = n / (n_ + n);
    tt_ += own * step_s * step_s + dt * dt * n_ * part;
    te_ += own * step_s * step_arcsec + dt * de * n_ * part;
    mean_t_ += dt * part;
    mean_e_ += de * part;
    n_ += n;
}

double Drift::slope_arcsec_s() const { return tt_ > 0.0 ? te_ / tt_ : 0.0; }

double ErrorMeter::drift_arcsec(const core::AngleRow& row, const TickTruth& truth, const SwitchWindow& window) const {
    const double nonmagnetic_arcsec = drift_law_.nonmagnetic_arcsec_s() * tick_s_;
    const bool is_measured = window.gap_is_over() && row.tick >= window.first_tick + window.n_ticks;
    if (!is_measured) return nonmagnetic_arcsec;
    const double start_s = static_cast<double>(row.tick) * tick_s_;
    const double magnetic_arcsec = drift_law_.magnetic_arcsec(start_s, start_s + tick_s_);
    return nonmagnetic_arcsec + row.mode * magnetic_arcsec - truth.taken_out_arcsec;
}

void ErrorMeter::take(const core::AngleRow& row, const TickTruth& truth, const std::deque<SwitchWindow>& windows) {
    const double own = row.dtheta_final_arcsec - truth.rotation_arcsec;
    error_.add(own);
    ++n_ticks_;
    const double t_s = static_cast<double>(row.tick + 1) * tick_s_;
    drift_.add(t_s, error_.value());
    if ((row.tick + 1) % stride_ == 0) {
        curve_.t_s.push_back(t_s);
        curve_.error_arcsec.push_back(error_.value());
    }
    for (const SwitchWindow& window : windows) {
        if (row.tick < window.first_tick || (window.gap_is_over() && row.tick > window.last_tick)) continue;
        if (row.tick == window.first_tick) current_ = SwitchError{.error_arcsec = rounding_before_arcsec_};
        if (!current_) continue;
        current_->error_arcsec += own - drift_arcsec(row, truth, window);
        current_->relock_arcsec += row.relock_arcsec;
        if ((row.flags & core::flag_unrepaired) != 0) current_->unrepaired = true;
        if (window.gap_is_over() && row.tick == window.last_tick) {
            current_->window = window;
            current_->error_arcsec -= truth.rounding_arcsec;
            done_.push_back(*current_);
            current_.reset();
        }
    }
    rounding_before_arcsec_ = truth.rounding_arcsec;
}

void ErrorMeter::leap(std::int64_t ticks, double error_arcsec) {
    const double from_arcsec = error_.value();
    const std::int64_t first = n_ticks_;
    error_.add(error_arcsec);
    n_ticks_ += ticks;
    const double end_s = static_cast<double>(n_ticks_) * tick_s_;
    drift_.add(static_cast<double>(ticks), tick_s_, end_s, from_arcsec, error_.value());
    for (std::int64_t at = (first / stride_ + 1) * stride_; at <= n_ticks_; at += stride_) {
        curve_.t_s.push_back(static_cast<double>(at) * tick_s_);
        curve_.error_arcsec.push_back(from_arcsec +
                                      error_arcsec * static_cast<double>(at - first) / static_cast<double>(ticks));
    }
}

}  // namespace zlg::study
