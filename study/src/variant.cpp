#include <zlg/study/variant.hpp>

#include <algorithm>
#include <cmath>

namespace zlg::study {

std::optional<SwitchStatistics> statistics(const std::vector<SwitchError>& errors) {
    if (errors.empty()) return std::nullopt;
    SwitchStatistics s;
    double sum_sq = 0.0;
    for (const SwitchError& e : errors) {
        s.mean_arcsec += e.window.sign_after * e.error_arcsec;
        sum_sq += e.error_arcsec * e.error_arcsec;
        s.max_arcsec = std::max(s.max_arcsec, std::abs(e.error_arcsec));
    }
    const auto n = static_cast<double>(errors.size());
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

double Drift::slope_arcsec_s() const { return tt_ > 0.0 ? te_ / tt_ : 0.0; }

void ErrorMeter::take(const core::AngleRow& row, double true_arcsec, const std::deque<SwitchWindow>& windows) {
    const double own = row.dtheta_final_arcsec - true_arcsec;
    error_.add(own);
    const double t_s = static_cast<double>(row.tick + 1) * tick_s_;
    drift_.add(t_s, error_.value());
    if ((row.tick + 1) % stride_ == 0) {
        curve_.t_s.push_back(t_s);
        curve_.error_arcsec.push_back(error_.value());
    }
    for (const SwitchWindow& window : windows) {
        if (row.tick < window.first_tick || (window.gap_is_over() && row.tick > window.last_tick)) continue;
        if (row.tick == window.first_tick) current_ = SwitchError{};
        if (!current_) continue;
        current_->error_arcsec += own;
        current_->relock_arcsec += row.relock_arcsec;
        if (window.gap_is_over() && row.tick == window.last_tick) {
            current_->window = window;
            done_.push_back(*current_);
            current_.reset();
        }
    }
}

}  // namespace zlg::study
