// Campaigns of the gyro in closed loop, and of its magnetic estimator.

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/trials/drift_campaign.hpp>
#include <zlg/trials/environment_campaign.hpp>
#include <zlg/trials/fault_campaign.hpp>
#include <zlg/trials/gyro_campaign.hpp>
#include <zlg/trials/magnetic_gate.hpp>
#include <zlg/trials/table_head.hpp>

#include "campaigns.hpp"

namespace zlg::trials {
namespace {

using config::Fidelity;

// One line for each limit that is not kept.
int judged(const std::vector<std::string>& complaints) {
    for (const std::string& line : complaints) fmt::print(stderr, "zlg_trials: {}\n", line);
    return complaints.empty() ? 0 : 1;
}

// Without the magnetic estimate and with it.
std::vector<DriftMethod> drift_methods() {
    DriftMethod alone{"joint, auto", {.relock = core::RelockMethod::joint}};
    DriftMethod magnetic{"joint, auto, magnetic", alone.compensation};
    magnetic.compensation.magnetic = core::MagneticMethod::estimate;
    return {magnetic, alone};
}

struct DriftOptions {
    DriftCampaign campaign{.threads = 2};
    double end_s = 36000.0;
    bool rest = false, tones = false;
    std::vector<double> intervals_s;
    std::vector<std::string> settings;
};

std::vector<DriftGyro> drift_gyros(const DriftOptions& o) {
    if (o.tones) return over_tones(200, o.campaign.seed);
    config::Config c;
    c.motion.frequency_hz = {20.06};
    if (o.rest) c.motion.kind = config::MotionKind::rest;
    c.switching.first_segment = config::FirstSegment::half;
    for (const std::string& setting : o.settings) config::apply_set(c, setting);
    std::vector<DriftGyro> gyros;
    for (const double interval_s : o.intervals_s) {
        c.switching.interval_s = interval_s;
        gyros.push_back({fmt::format("fixed {} s, first half", interval_s), c, drift_methods()});
    }
    if (!gyros.empty()) return gyros;
    c.switching.schedule = config::Schedule::measured;
    for (const DriftMethod& method : drift_methods()) gyros.push_back({"measured, first half", c, {method}});
    return gyros;
}

// Root mean squares over the runs; of single runs the worst. A run is bad where the estimator adds more than a fifth to
// the error.
struct GateRow {
    double without_sq = 0.0, with_sq = 0.0, error_sq = 0.0, trust = 0.0;
    double worst_ratio = 0.0;
    int n = 0, n_bad = 0;

    void add(const GateResult& r) {
        const double ratio = r.with_arcsec / r.without_arcsec;
        without_sq += r.without_arcsec * r.without_arcsec;
        with_sq += r.with_arcsec * r.with_arcsec;
        error_sq += r.error_arcsec_s * r.error_arcsec_s;
        trust += r.trust;
        worst_ratio = std::max(worst_ratio, ratio);
        ++n;
        n_bad += ratio > 1.2;
    }
    void print(const std::string& base) const {
        fmt::print("| {} | {:.2f} | {:.2f} | {:.3f} | {:.2f} | {:.3f} | {:.3f} | {} |\n", base,
                   std::sqrt(without_sq / n), std::sqrt(with_sq / n), std::sqrt(with_sq / without_sq), worst_ratio,
                   std::sqrt(error_sq / n), trust / n, n_bad);
    }
};

struct GateOptions {
    MagneticGate gate;
    int seeds = 10;
    std::string only;
};

int print_gate(const GateOptions& o) {
    fmt::print("{}", table_head({"base", "without, arcsec rms", "with", "ratio", "of the worst run",
                                 "error of the drift, arcsec/s", "trust", "runs above 1.2"}));
    for (const MovingBase& base : moving_bases(o.gate)) {
        if (base.name.find(o.only) == std::string::npos) continue;
        GateRow row;
        for (int seed = 1; seed <= o.seeds; ++seed)
            row.add(gate_result(o.gate, base, static_cast<std::uint64_t>(seed)));
        row.print(base.name);
    }
    return 0;
}

}  // namespace

// A laser takes 30 times as long.
Work faults(CLI::App& app) {
    const auto campaign = std::make_shared<FaultCampaign>(FaultCampaign{.faults = 10'000, .threads = 2});
    const std::map<std::string, Fidelity> fidelities{{"averaged", Fidelity::averaged}, {"laser", Fidelity::laser}};
    std::map<std::string, twin::FaultKind> kinds;
    for (const twin::FaultKind kind : twin::all_fault_kinds) kinds.emplace(twin::facts(kind).name, kind);
    app.add_option("FAULTS", campaign->faults)->check(CLI::PositiveNumber);
    app.add_option("KIND", campaign->kinds, "of docs/faults.md")->transform(CLI::CheckedTransformer(kinds));
    app.add_option("--fidelity", campaign->fidelity)->transform(CLI::CheckedTransformer(fidelities));
    app.add_flag_callback(
        "--bench", [campaign] { campaign->surroundings = Surroundings::bench; },
        "unequal light, fast motions, both readouts, up to 300 s, from power-up on, two to six at once");
    add_seed_and_threads(app, *campaign);
    return [campaign] {
        const std::vector<FaultFigures> figures = run(*campaign);
        fmt::print("{}", markdown(figures));
        return judged(complaints(figures));
    };
}

// A gyro of 60 to 600 s takes about a second, a laser ten; one gyro of four is a laser.
Work gyros(CLI::App& app) {
    const auto campaign = std::make_shared<GyroCampaign>(GyroCampaign{
        .gyros = 300, .fidelities = {Fidelity::averaged, Fidelity::averaged, Fidelity::averaged, Fidelity::laser}});
    const auto each = std::make_shared<bool>(false);
    app.add_option("GYROS", campaign->gyros)->check(CLI::PositiveNumber);
    app.add_option("--first", campaign->first, "number of the first gyro");
    app.add_flag("--each", *each, "a row for each gyro");
    add_seed_and_threads(app, *campaign);
    return [campaign, each] {
        const std::vector<GyroOutcome> outcomes = run(*campaign);
        if (*each) fmt::print("{}\n", gyros_markdown(outcomes));
        fmt::print("{}", summary_markdown(outcomes));
        return judged(complaints(outcomes));
    };
}

// An hour of a gyro takes about five seconds.
Work environment(CLI::App& app) {
    const auto campaign = std::make_shared<EnvironmentCampaign>();
    app.add_option("GYROS", campaign->gyros)->check(CLI::PositiveNumber);
    app.add_option("--seconds", campaign->run_s)->check(CLI::PositiveNumber);
    add_seed_and_threads(app, *campaign);
    return [campaign] {
        const std::vector<EnvironmentOutcome> outcomes = run(*campaign);
        fmt::print("{}", markdown(outcomes));
        return judged(complaints(outcomes));
    };
}

// A run of 36 000 s takes half a minute a gyro and core.
Work drift(CLI::App& app) {
    const auto o = std::make_shared<DriftOptions>();
    app.add_option("SEEDS", o->campaign.seeds)->check(CLI::PositiveNumber);
    app.add_option("--seconds", o->end_s)->check(CLI::PositiveNumber);
    app.add_flag("--rest", o->rest, "in place of 12 000 arcsec/s at 20.06 Hz");
    app.add_option("--interval", o->intervals_s, "s, fixed, in place of the schedule measured; repeatable")
        ->check(CLI::PositiveNumber);
    app.add_flag("--tones", o->tones, "200 gyros without a magnetic drift over drawn tones");
    app.add_option("--set", o->settings, "section.key=value, of all gyros; repeatable")->allow_extra_args(false);
    add_seed_and_threads(app, o->campaign);
    return [o] {
        for (const double time_s : {600.0, 900.0, 3600.0})
            if (time_s < o->end_s) o->campaign.times_s.push_back(time_s);
        o->campaign.times_s.push_back(o->end_s);
        o->campaign.gyros = drift_gyros(*o);
        fmt::print("{}", markdown(run(o->campaign)));
        return 0;
    };
}

Work magnetic(CLI::App& app) {
    using core::ScheduleKind;
    const auto o = std::make_shared<GateOptions>();
    const std::map<std::string, ScheduleKind> kinds{{"fixed", ScheduleKind::fixed},
                                                    {"measured", ScheduleKind::measured}};
    app.add_option("INTERVAL_S", o->gate.interval_s)->check(CLI::PositiveNumber);
    app.add_option("RUN_S", o->gate.run_s)->check(CLI::PositiveNumber);
    app.add_option("SEEDS", o->seeds)->check(CLI::PositiveNumber);
    app.add_option("--schedule", o->gate.schedule)->transform(CLI::CheckedTransformer(kinds));
    app.add_option("--only", o->only, "bases whose name contains this");
    return [o] { return print_gate(*o); };
}

}  // namespace zlg::trials
