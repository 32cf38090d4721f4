#include <zlg/twin/motion.hpp>

#include <utility>

#include "motion_source.hpp"

namespace zlg::twin {

Motion::Motion(std::shared_ptr<const Source> source) : source_{std::move(source)} {}

Motion Motion::rest() { return sines(0.0, {}); }

Motion Motion::sines(double rate_arcsec_s, const std::vector<Sine>& sines) {
    return Motion{make_sines(rate_arcsec_s, sines)};
}

Motion Motion::from_increments(std::vector<double> increment_arcsec, double rate_hz) {
    return Motion{make_sampled(std::move(increment_arcsec), rate_hz)};
}

Motion Motion::with_steps(Motion base, std::shared_ptr<const std::vector<RateStep>> steps) {
    return Motion{make_steps(std::move(base.source_), std::move(steps))};
}

double Motion::increment_arcsec(double t0_s, double t1_s) const { return source_->increment_arcsec(t0_s, t1_s); }

void Motion::increments_arcsec(double t0_s, double step_s, std::span<double> out) const {
    source_->increments_arcsec(t0_s, step_s, out);
}

double Motion::duration_s() const { return source_->duration_s(); }

double Motion::fastest_arcsec_s() const { return source_->fastest_arcsec_s(); }

bool Motion::is_even() const { return source_->is_even(); }

}  // namespace zlg::twin
