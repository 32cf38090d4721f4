#pragma once
// The twin's true false drift after re-lock, tick by tick, averaged over the switches (Table 1 of the paper).

#include <vector>

#include <zlg/core/records.hpp>

namespace zlg::study {

class RelockProfile {
public:
    explicit RelockProfile(int ticks) : sum_arcsec_(static_cast<std::size_t>(ticks)), n_(sum_arcsec_.size()) {}

    void take(const core::HalfRecord& first, const core::HalfRecord& second, double false_arcsec) {
        if (!first.loop_closed || !second.loop_closed) {
            next_ = 0;
            return;
        }
        if (next_ >= sum_arcsec_.size()) return;
        // A closed loop's false angle has the sign of the smaller deficit, that of the second half: minus the first's.
        sum_arcsec_[next_] -= first.bias_sign * first.mode * false_arcsec;
        ++n_[next_++];
    }

    // 1 arcsec/s is 1 deg/h.
    [[nodiscard]] std::vector<double> mean_deg_h(double tick_s) const {
        std::vector<double> mean;
        for (std::size_t i = 0; i < n_.size() && n_[i] > 0; ++i)
            mean.push_back(sum_arcsec_[i] / static_cast<double>(n_[i]) / tick_s);
        return mean;
    }

private:
    std::vector<double> sum_arcsec_;
    std::vector<long> n_;
    std::size_t next_ = static_cast<std::size_t>(-1);  // before the first switch nothing counts
};

}  // namespace zlg::study
