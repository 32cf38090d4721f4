#include "recording.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::trials {
namespace {

bool is_finite(const core::HalfRecord& r) {
    return std::isfinite(r.detuning_lambda) && std::isfinite(r.detuning_sq_lambda2) && std::isfinite(r.piezo_v) &&
           std::isfinite(r.temperature_c);
}

bool is_finite(const core::ActuatorFrame& a) {
    return std::ranges::all_of(a.set_point_v, [](double v) { return std::isfinite(v); });
}

bool is_finite(const core::AngleRow& r) {
    return std::isfinite(r.dtheta_arcsec) && std::isfinite(r.dtheta_final_arcsec) && !std::isnan(r.sigma_arcsec);
}

class Recorder {
public:
    Recorder(const config::Config& config, double end_s)
        : replay_{rig::asked_compensation(config)},
          loop_{config, rig::motion(config)},
          n_ticks_{std::llround(end_s / config.gyro.tick_s)} {}

    GyroHistory record() {
        for (std::int64_t tick = 0; tick < n_ticks_; ++tick) add_tick();
        replay_.end([this](const core::AngleRow& row) { add(row); },
                    [this](const core::GapReport& gap) { history_.gaps.push_back(gap); });
        return std::move(history_);
    }

private:
    void add_tick() {
        double turned_arcsec = 0.0;
        bool lit = true;
        double detuning_lambda = 0.0;
        for (int k = 0; k < 2; ++k) {
            const rig::LoopHalf half = loop_.advance();
            history_.health.push_back(half.control.health);
            history_.half_valid.push_back(half.record.valid);
            history_.not_finite |= !is_finite(half.record) || !is_finite(half.control.actuator);
            turned_arcsec += half.truth.dtheta_arcsec;
            lit = lit && half.truth.lit;
            detuning_lambda = half.truth.detuning_end_lambda;
            const core::CompensationOutput out = replay_.take(
                half.record, {}, [this](const core::AngleRow& row) { add(row); },
                [this](const core::GapReport& gap) { history_.gaps.push_back(gap); });
            history_.not_finite |= !std::isfinite(out.angle_arcsec) || !std::isfinite(out.sample.dtheta_arcsec);
        }
        history_.true_arcsec.push_back(turned_arcsec);
        history_.lit.push_back(lit);
        history_.detuning_lambda.push_back(detuning_lambda);
    }

    void add(const core::AngleRow& row) {
        history_.not_finite |= !is_finite(row);
        history_.rows.push_back(row);
    }

    rig::Replay replay_;
    rig::ClosedLoop loop_;
    std::int64_t n_ticks_;
    GyroHistory history_;
};

}  // namespace

GyroHistory simulate(const config::Config& config, double end_s) { return Recorder{config, end_s}.record(); }

}  // namespace zlg::trials
