#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "motion_source.hpp"

namespace zlg::twin {
namespace {

// The integral of a rate that is linear from step to step, over that of the base. Where no step lies before t1 the
// increment is that of the base to the last bit.
//
// cost  of increment_arcsec: a step for each that lies within, and the search for the last.
class Steps final : public Motion::Source {
public:
    Steps(std::shared_ptr<const Motion::Source> base, std::shared_ptr<const std::vector<RateStep>> steps)
        : base_{std::move(base)}, steps_{std::move(steps)} {}

    [[nodiscard]] double increment_arcsec(double t0_s, double t1_s) const override {
        if (t1_s < t0_s) return -increment_arcsec(t1_s, t0_s);
        double sum = base_->increment_arcsec(t0_s, t1_s);
        double end_s = t1_s;
        auto step = std::lower_bound(steps_->begin(), steps_->end(), end_s,
                                     [](const RateStep& s, double at_s) { return s.at_s < at_s; });
        while (step != steps_->begin() && end_s > t0_s) {
            --step;
            const double begin_s = std::max(step->at_s, t0_s);
            const double middle_s = 0.5 * (begin_s + end_s) - step->at_s;
            sum += (step->rate_arcsec_s + step->slope_arcsec_s2 * middle_s) * (end_s - begin_s);
            end_s = begin_s;
        }
        return sum;
    }

    [[nodiscard]] double duration_s() const override { return base_->duration_s(); }

    // Of steps that may still be added nobody knows; a slope without an end has none.
    [[nodiscard]] double fastest_arcsec_s() const override {
        double fastest = 0.0;
        for (std::size_t k = 0; k < steps_->size(); ++k) {
            const RateStep& step = (*steps_)[k];
            fastest = std::max(fastest, std::abs(step.rate_arcsec_s));
            if (step.slope_arcsec_s2 == 0.0) continue;
            if (k + 1 == steps_->size()) return std::numeric_limits<double>::infinity();
            const double lasts_s = (*steps_)[k + 1].at_s - step.at_s;
            fastest = std::max(fastest, std::abs(step.rate_arcsec_s + step.slope_arcsec_s2 * lasts_s));
        }
        return base_->fastest_arcsec_s() + fastest;
    }

private:
    std::shared_ptr<const Motion::Source> base_;
    std::shared_ptr<const std::vector<RateStep>> steps_;
};

}  // namespace

std::shared_ptr<const Motion::Source> make_steps(std::shared_ptr<const Motion::Source> base,
                                                 std::shared_ptr<const std::vector<RateStep>> steps) {
    return std::make_shared<Steps>(std::move(base), std::move(steps));
}

}  // namespace zlg::twin
