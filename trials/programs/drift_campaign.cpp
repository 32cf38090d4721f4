// Drift of long runs in closed loop, in excess of the non-magnetic one: plain switching at several fixed intervals with
// the paper's compensation, and what schedule, bridge and magnetic estimator make of it. A table in Markdown.
//
// usage: zlg_drift_campaign [SEEDS [SECONDS [THREADS [vibration|rest [PART]]]]]
// PART: plain (fixed intervals), ours, or all. A run of 36 000 s takes half a minute a gyro and core.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <zlg/trials/drift_campaign.hpp>

namespace {

using namespace zlg;

config::Config gyro_on(std::string_view base) {
    config::Config c;
    c.motion.frequency_hz = {20.06};
    if (base == "rest") c.motion.kind = config::MotionKind::rest;
    return c;
}

trials::DriftMethod papers() {
    trials::DriftMethod m{.name = "detuning, quadratic", .compensation = {}};
    m.compensation.relock = core::RelockMethod::detuning;
    m.compensation.bridge = core::BridgeMethod::quadratic;
    return m;
}

trials::DriftMethod ours(core::MagneticMethod magnetic) {
    trials::DriftMethod m{.name = "joint, auto", .compensation = {}};
    m.compensation.relock = core::RelockMethod::joint;
    m.compensation.bridge = core::BridgeMethod::automatic;
    m.compensation.magnetic = magnetic;
    if (magnetic == core::MagneticMethod::estimate) m.name += ", magnetic";
    return m;
}

void add_plain(trials::DriftCampaign& campaign, const config::Config& base) {
    // No whole numbers of periods of the vibration, with which errors would add up instead of averaging out.
    for (const double interval_s : {61.3, 91.7, 153.1, 251.3, 401.9, 607.7}) {
        config::Config c = base;
        c.switching.interval_s = interval_s;
        campaign.gyros.push_back({fmt::format("fixed {} s", interval_s), c, {papers()}});
    }
}

void add_ours(trials::DriftCampaign& campaign, const config::Config& base) {
    const trials::DriftMethod alone = ours(core::MagneticMethod::none);
    const trials::DriftMethod magnetic = ours(core::MagneticMethod::estimate);
    config::Config c = base;
    c.switching.first_segment = config::FirstSegment::half;
    c.switching.schedule = config::Schedule::measured;
    campaign.gyros.push_back({"measured, first half", c, {magnetic}});
    campaign.gyros.push_back({"measured, first half", c, {alone}});
    config::Config ending = c;
    ending.switching.last_segment = config::LastSegment::half;
    campaign.gyros.push_back({"measured, first and last half", ending, {magnetic}});
    campaign.gyros.push_back({"measured, first and last half", ending, {alone}});
    c.switching.schedule = config::Schedule::fixed;
    c.switching.interval_s = 61.3;
    campaign.gyros.push_back({"fixed 61.3 s, first half", c, {alone, magnetic}});
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
    const auto number = [&](int k, std::int64_t otherwise) { return argc > k ? std::atoll(argv[k]) : otherwise; };
    const std::string_view part = argc > 5 ? argv[5] : "all";
    trials::DriftCampaign campaign{.seeds = number(1, 10), .threads = static_cast<int>(number(3, 2))};
    const auto end_s = static_cast<double>(number(2, 36000));
    for (const double time_s : {600.0, 900.0, 3600.0}) {
        if (time_s < end_s) campaign.times_s.push_back(time_s);
    }
    campaign.times_s.push_back(end_s);
    const config::Config base = gyro_on(argc > 4 ? argv[4] : "vibration");
    if (part != "ours") add_plain(campaign, base);
    if (part != "plain") add_ours(campaign, base);
    print_all(campaign);
    return 0;
}
