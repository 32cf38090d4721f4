// Drift of long runs in closed loop, in excess of the non-magnetic one: plain switching at several fixed intervals with
// the paper's compensation, and what schedule, bridge and magnetic estimator make of it. A table in Markdown.
//
// A run of 36 000 s takes half a minute a gyro and core.

#include <cstdio>

#include <zlg/config/schema.hpp>
#include <zlg/trials/drift_campaign.hpp>

#include "command.hpp"

namespace {

using namespace zlg;

using Gyros = std::vector<trials::DriftGyro>;

void add_plain(Gyros& gyros, config::Config c) {
    const trials::DriftMethod paper{"detuning, quadratic",
                                    {.relock = core::RelockMethod::detuning, .bridge = core::BridgeMethod::quadratic}};
    // No whole numbers of periods of the vibration, with which errors would add up instead of averaging out.
    for (const double interval_s : {61.3, 91.7, 153.1, 251.3, 401.9, 607.7}) {
        c.switching.interval_s = interval_s;
        gyros.push_back({fmt::format("fixed {} s", interval_s), c, {paper}});
    }
}

// `joint`, without the magnetic estimate and with it.
std::vector<trials::DriftMethod> our_methods(const config::Config& c) {
    trials::DriftMethod alone{"joint, auto", c.compensation};
    alone.compensation.relock = core::RelockMethod::joint;
    trials::DriftMethod magnetic{"joint, auto, magnetic", alone.compensation};
    magnetic.compensation.magnetic = core::MagneticMethod::estimate;
    return {magnetic, alone};
}

void add_measured(Gyros& gyros, config::Config c) {
    c.switching.first_segment = config::FirstSegment::half;
    c.switching.schedule = config::Schedule::measured;
    for (const auto& method : our_methods(c)) gyros.push_back({"measured, first half", c, {method}});
}

void add_ended(Gyros& gyros, config::Config c) {
    c.switching.first_segment = config::FirstSegment::half;
    c.switching.schedule = config::Schedule::measured;
    c.switching.last_segment = config::LastSegment::half;
    for (const auto& method : our_methods(c)) gyros.push_back({"measured, first and last half", c, {method}});
}

void add_fixed(Gyros& gyros, config::Config c, const std::vector<double>& intervals_s) {
    c.switching.first_segment = config::FirstSegment::half;
    for (const double interval_s : intervals_s) {
        c.switching.interval_s = interval_s;
        gyros.push_back({fmt::format("fixed {} s, first half", interval_s), c, our_methods(c)});
    }
}

// Gyro by gyro, so that what is done is seen.
void print_all(const trials::DriftCampaign& campaign) {
    bool headed = false;
    for (const trials::DriftGyro& gyro : campaign.gyros) {
        trials::DriftCampaign one = campaign;
        one.gyros = {gyro};
        const std::string table = trials::markdown(trials::run(one));
        const std::size_t head = table.find('\n', table.find('\n') + 1) + 1;
        fmt::print("{}", headed ? table.substr(head) : table);
        std::fflush(stdout);
        headed = true;
    }
}

}  // namespace

int main(int argc, char** argv) {
    trials::DriftCampaign campaign{.threads = 2};
    double end_s = 36000.0;
    std::string base = "vibration";
    std::string part = "all";
    std::vector<double> intervals_s{61.3};
    std::vector<std::string> sets;
    CLI::App app{"Drift of long runs in excess of the non-magnetic one", "zlg_drift_campaign"};
    app.add_option("SEEDS", campaign.seeds)->check(CLI::PositiveNumber);
    app.add_option("SECONDS", end_s)->check(CLI::PositiveNumber);
    app.add_option("THREADS", campaign.threads)->check(CLI::PositiveNumber);
    app.add_option("BASE", base)->check(CLI::IsMember({"vibration", "rest"}));
    app.add_option(
           "PART", part,
           "plain: the paper's compensation at fixed intervals; measured, fixed: parts of ours; tones: 200 drawn")
        ->check(CLI::IsMember({"plain", "measured", "fixed", "ours", "tones", "all"}));
    app.add_option("--interval", intervals_s, "of ours at a fixed one, s; repeatable")->check(CLI::PositiveNumber);
    app.add_option("--set", sets, "section.key=value, of all gyros; repeatable")->allow_extra_args(false);
    app.add_option("--first-seed", campaign.first_seed);
    return trials::run_command(app, argc, argv, [&] {
        for (const double time_s : {600.0, 900.0, 3600.0})
            if (time_s < end_s) campaign.times_s.push_back(time_s);
        campaign.times_s.push_back(end_s);
        config::Config c;
        c.motion.frequency_hz = {20.06};
        if (base == "rest") c.motion.kind = config::MotionKind::rest;
        for (const std::string& set : sets) config::apply_set(c, set);
        const bool ours = part == "ours" || part == "all";
        if (part == "plain" || part == "all") add_plain(campaign.gyros, c);
        if (part == "measured" || ours) add_measured(campaign.gyros, c);
        if (ours) add_ended(campaign.gyros, c);
        if (part == "fixed" || ours) add_fixed(campaign.gyros, c, intervals_s);
        if (part == "tones") campaign.gyros = trials::over_tones(200, campaign.first_seed);
        print_all(campaign);
        return 0;
    });
}
