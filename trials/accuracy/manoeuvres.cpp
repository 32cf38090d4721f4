#include "manoeuvres.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <zlg/chance/draw.hpp>
#include <zlg/core/common/maths_kernels.hpp>

#include "synthetic/gyro.hpp"

namespace zlg::trials {
namespace {

using std::numbers::pi;

// A gap disturbs nothing earlier before it and nothing later after it.
constexpr std::int64_t lead_ticks = 9;
constexpr std::int64_t trail_ticks = 40;
constexpr double place_ticks = 8.0;

// Ticks of the common motion from one copy to the next, and up to so many more at random.
constexpr std::int64_t step_ticks = 11;

struct Compensation {
    explicit Compensation(const AccuracyMethod& method) : config{method.config}, bank{method.bank} {
        state.bridge.background.worker.is_background = true;
    }

    core::CompensationOutput take(const SyntheticHalf& half) {
        const core::CompensationOutput out = core::step(config, state, half.record, half.light);
        if (out.has_sample) core::work(config, state, nullptr, bank);
        return out;
    }

    core::GyroCompensationConfig config;
    std::vector<core::BankMember> bank;
    core::GyroCompensationState state{};
};

double start_of(const Manoeuvre& m, const GyroLaw& law, chance::Draw& draw) {
    const double gap_s = law.tick_s * law.gap_ticks;
    const double beside_s = place_ticks * law.tick_s * draw.uniform();
    switch (m.place) {
        case ManoeuvrePlace::ended: return -beside_s - m.duration_s;
        case ManoeuvrePlace::before: return -beside_s;
        case ManoeuvrePlace::in: return gap_s * beside_s / (place_ticks * law.tick_s);
        case ManoeuvrePlace::after: break;
    }
    return gap_s + beside_s;
}

// One gap, with all of its manoeuvre, in copies of the common motion.
class Gap {
public:
    Gap(const ManoeuvreTrial& trial, const Manoeuvre& manoeuvre, const SyntheticGyro& gyro,
        const std::vector<Compensation>& compensations, double rounding_arcsec, std::int64_t tick, chance::Draw& draw)
        : trial_{trial},
          manoeuvre_{manoeuvre},
          gyro_{gyro},
          compensations_{compensations},
          errors_(compensations.size(), {.sigma_arcsec = std::numeric_limits<double>::infinity()}),
          lead_{lead_of(trial, manoeuvre)},
          first_{tick + lead_ - lead_ticks},
          opening_{tick + lead_},
          start_s_{start_of(manoeuvre, trial.gyro, draw)},
          sign_{draw.sign()},
          rounding_arcsec_{rounding_arcsec},
          tick_{tick} {
        seed_ = draw.bits();
        gyro_.draw_anew(seed_);
    }

    std::vector<SwitchError> run() {
        const std::int64_t closing = opening_ + trial_.gyro.gap_ticks;
        for (; tick_ < closing + trail_ticks; ++tick_) advance_tick();
        for (std::size_t m = 0; m < compensations_.size(); ++m) {
            for (core::DrainOutput out = drain(m); out.has_row || out.has_gap; out = drain(m))
                if (out.has_row) add(out.row, errors_[m]);
            errors_[m].error_arcsec -= rotation_arcsec_ + rounding_arcsec_ - rounding_before_arcsec_;
        }
        return errors_;
    }

private:
    // Ticks from the copy to the gap.
    static std::int64_t lead_of(const ManoeuvreTrial& trial, const Manoeuvre& m) {
        const auto whole = static_cast<std::int64_t>(std::ceil(m.duration_s / trial.gyro.tick_s));
        return 2 * lead_ticks + (m.place == ManoeuvrePlace::ended ? whole : 0);
    }

    core::DrainOutput drain(std::size_t m) { return core::drain(compensations_[m].config, compensations_[m].state); }

    void advance_tick() {
        if (tick_ == first_) rounding_before_arcsec_ = rounding_arcsec_;
        if (tick_ == opening_) {
            gyro_.open();
            if (manoeuvre_.next) gyro_.move_by(*manoeuvre_.next, seed_);
        }
        for (int h = 0; h < 2; ++h) {
            const double half_s = 0.5 * trial_.gyro.tick_s;
            const double t = static_cast<double>(2 * (tick_ - opening_) + h) * half_s - start_s_;
            const double angle = manoeuvre_angle(manoeuvre_.law, manoeuvre_.duration_s, t + half_s) -
                                 manoeuvre_angle(manoeuvre_.law, manoeuvre_.duration_s, t);
            const SyntheticHalf half = gyro_.advance(sign_ * manoeuvre_.rate_arcsec_s * angle);
            if (tick_ >= first_) rotation_arcsec_ += half.true_arcsec;
            rounding_arcsec_ = half.rounding_arcsec;
            for (std::size_t m = 0; m < compensations_.size(); ++m) take(half, compensations_[m], errors_[m]);
        }
    }

    void take(const SyntheticHalf& half, Compensation& c, SwitchError& error) {
        const core::CompensationOutput out = c.take(half);
        if (!out.has_sample) return;
        if (out.sample.has_final) add(out.sample.final_row, error);
        if (out.sample.has_gap && out.sample.gap.first_tick == opening_)
            error.sigma_arcsec = out.sample.gap.sigma_sum_arcsec;
    }

    void add(const core::AngleRow& row, SwitchError& error) const {
        if (row.tick >= first_) error.error_arcsec += row.dtheta_final_arcsec;
    }

    const ManoeuvreTrial& trial_;
    const Manoeuvre& manoeuvre_;
    SyntheticGyro gyro_;
    std::vector<Compensation> compensations_;
    std::vector<SwitchError> errors_;
    std::int64_t lead_, first_, opening_;
    double start_s_, sign_;
    double rotation_arcsec_ = 0.0, rounding_arcsec_, rounding_before_arcsec_ = 0.0;
    std::int64_t tick_;
    std::uint64_t seed_ = 0;
};

// The common motion, tick by tick.
struct Common {
    SyntheticGyro gyro;
    std::vector<Compensation> compensations;
    std::int64_t tick = 0;
    double rounding_arcsec = 0.0;

    void advance() {
        for (int h = 0; h < 2; ++h) {
            const SyntheticHalf half = gyro.advance();
            rounding_arcsec = half.rounding_arcsec;
            for (Compensation& c : compensations) (void)c.take(half);
        }
        ++tick;
    }
};

}  // namespace

double manoeuvre_angle(ManoeuvreLaw law, double duration_s, double t_s) {
    if (t_s <= 0.0) return 0.0;
    const double x = t_s / duration_s;
    if (law == ManoeuvreLaw::exponential) return duration_s * (x + core::maths::expm1(-3.0 * x) / 3.0);
    if (law == ManoeuvreLaw::pulse)
        return x < 1.0 ? 0.5 * duration_s * (x - core::maths::sincos_turns_kernel(x).sin / (2.0 * pi))
                       : 0.5 * duration_s;
    if (x >= 1.0) return duration_s * (x - 0.5);
    return duration_s *
           (law == ManoeuvreLaw::linear ? 0.5 * x * x : 0.5 * (x - core::maths::sincos_turns_kernel(0.5 * x).sin / pi));
}

std::vector<std::vector<std::vector<SwitchError>>> run_manoeuvres(const ManoeuvreTrial& trial,
                                                                  const std::vector<AccuracyMethod>& methods) {
    Common common{.gyro = {trial.gyro, trial.motion, trial.seed}, .compensations = {}};
    for (const AccuracyMethod& m : methods) common.compensations.emplace_back(m);
    while (common.tick < trial.learn_ticks) common.advance();
    std::vector<std::vector<std::vector<SwitchError>>> errors(trial.manoeuvres.size());
    for (auto& of_manoeuvre : errors) of_manoeuvre.resize(methods.size());
    chance::Draw step{trial.seed, chance::Cause::manoeuvre_step};
    for (int k = 0; k < trial.gaps; ++k) {
        for (std::size_t i = 0; i < trial.manoeuvres.size(); ++i) {
            chance::Draw draw{trial.seed, chance::Cause::manoeuvre, static_cast<std::uint64_t>(k),
                              static_cast<std::uint32_t>(i)};
            Gap gap{trial, trial.manoeuvres[i], common.gyro, common.compensations, common.rounding_arcsec, common.tick,
                    draw};
            const std::vector<SwitchError> found = gap.run();
            for (std::size_t m = 0; m < methods.size(); ++m) errors[i][m].push_back(found[m]);
        }
        const auto ticks = step_ticks + static_cast<std::int64_t>(step_ticks * step.uniform());
        for (std::int64_t t = 0; t < ticks; ++t) common.advance();
    }
    return errors;
}

}  // namespace zlg::trials
