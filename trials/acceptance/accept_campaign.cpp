#include <zlg/trials/accept_campaign.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include <zlg/acceptance/accept.hpp>
#include <zlg/chance/draw.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/study/run.hpp>

namespace zlg::trials {
namespace {

using acceptance::Verdict;
using chance::Draw;
using chance::Draws;

constexpr std::uint64_t first_trial = std::uint64_t{1} << 40;  // beyond those of the noise campaign
constexpr std::size_t n_samples = 4096;

struct Unit {
    double bias = 0.0, bias_limit = 0.0;
    double walk = 1.0, walk_limit = 0.0;  // arcsec/sqrt(s)
    double rate_walk = 0.0;
    bool filtered = false;
    int fault = 0;  // 0: none
};

// Well within, near or well beyond a limit at 0, in uncertainties.
double place(Draw draw, double near) { return std::array{-20.0, draw.within(-near, near), 20.0}[draw.below(3)]; }

Unit unit_of(const Draws& draws, int k) {
    Unit u;
    u.walk = draws.of("white").within_log(0.1, 10.0);
    if (k % 2 == 0) u.rate_walk = u.walk * std::sqrt(3.0) / (static_cast<double>(n_samples) / 16.0);
    u.filtered = k % 3 == 0;
    const double t = n_samples;
    const double sigma = std::sqrt(u.walk * u.walk / t + u.rate_walk * u.rate_walk * t / 3.0);
    u.bias_limit = 50.0 * sigma;
    // Farther than what stays undecided, so that this tells nothing of the side.
    u.bias = u.bias_limit + sigma * place(draws.of("bias"), 6.0);
    u.walk_limit = u.walk / (1.0 + 0.015 * place(draws.of("walk"), 3.0)) / 60.0;
    if (k % 10 == 9) u.fault = 1 + (k / 10) % 4;
    return u;
}

// The low pass is a mean over two samples; the walk begins at 0, so that the mean rate is the bias and its own mean.
std::vector<double> record_of(const Unit& u, const Draws& draws, std::size_t n) {
    Draw white = draws.of("white noise"), steps = draws.of("walk of the rate");
    std::vector<double> rates(n);
    double walk = 0.0, last = white.normal();
    for (double& rate : rates) {
        const double next = white.normal(), step = u.rate_walk * steps.normal();
        rate = u.bias + walk + 0.5 * step + u.walk * (u.filtered ? 0.5 * (next + last) : next);
        walk += step;
        last = next;
    }
    const double middle = u.bias, at = rates[n / 2];
    for (std::size_t k = 0; k < n; ++k) {
        if (u.fault == 1) rates[k] = middle;                                                              // dead
        if (u.fault == 2 && k > n / 2 && k < n / 2 + 400) rates[k] = at;                                  // held
        if (u.fault == 3) rates[k] = std::clamp(rates[k], middle - 0.5 * u.walk, middle + 0.5 * u.walk);  // clipped
        if (u.fault == 4) rates[k] = rates[k - k % 2];                                                    // doubled
    }
    return rates;
}

acceptance::Acceptance tested(const std::string& folder, const std::string& run, const std::string& limits) {
    std::ofstream{folder + "/plan.toml"} << "[unit]\nserial = \"trial\"\n[[run]]\nkind = \"static\"\n"
                                         << run << "[limits]\n"
                                         << limits;
    return acceptance::accept({.plan = folder + "/plan.toml", .said = {}});
}

acceptance::Acceptance foreign_test(const std::string& folder, const Unit& u, const Draws& draws, std::size_t n) {
    {
        std::ofstream log{folder + "/log.csv"};
        for (const double rate : record_of(u, draws, n)) log << fmt::format("{}\n", rate);
    }
    return tested(
        folder, "files = [\"log.csv\"]\ncolumn = 1\ntime = \"none\"\nholds = \"rate\"\nunit = \"deg/h\"\nrate_hz = 1\n",
        fmt::format("\"bias.deg_h\" = {{ max = {} }}\n\"angle_random_walk.deg_sqrt_h\" = {{ max = {} }}\n",
                    u.bias_limit, u.walk_limit));
}

const acceptance::Judged& judged(const acceptance::Acceptance& test, const char* name) {
    return *std::ranges::find_if(test.quantities, [&](const acceptance::Judged& q) { return q.value.name == name; });
}

void score(const acceptance::Judged& q, double truth, double limit, VerdictScore& s) {
    const bool beyond = truth > limit;
    (beyond ? s.beyond : s.within) += 1;
    if (beyond && q.verdict == Verdict::pass) ++s.passed;
    if (!beyond && q.verdict == Verdict::fail) ++s.failed;
    if (q.verdict == Verdict::undecided) ++s.undecided;
    if (!q.value.determined || q.value.value == 0.0) return;
    ++s.known;
    s.squares += std::pow((q.value.value - truth) / q.value.uncertainty, 2);
}

void foreign_trial(const AcceptCampaignTask& task, int k, AcceptCampaign& campaign) {
    const auto trial = first_trial + static_cast<std::uint64_t>(k);
    const Unit u = unit_of({task.seed, chance::Cause::noise_gyro, trial}, k);
    const Draws records{task.seed, chance::Cause::noise_record, trial};
    const acceptance::Acceptance test = foreign_test(task.folder, u, records, n_samples);
    const acceptance::Judged& bias = judged(test, "bias.deg_h");
    if (u.fault != 0) {
        ++campaign.faulty;
        if (bias.verdict == Verdict::not_determined) ++campaign.stopped;
        return;
    }
    VerdictScore& s = campaign.quantities["bias.deg_h"];
    score(bias, u.bias, u.bias_limit, s);
    score(judged(test, "angle_random_walk.deg_sqrt_h"), u.walk / 60.0, u.walk_limit,
          campaign.quantities["angle_random_walk.deg_sqrt_h"]);
    if (bias.verdict != Verdict::undecided || !bias.more_hours) return;
    ++s.predicted;
    for (std::size_t part = 0; part < s.decided.size(); ++part) {
        const double longer = 1.0 + VerdictScore::parts.at(part) * *bias.more_hours / bias.value.hours;
        const acceptance::Acceptance again =
            foreign_test(task.folder, u, records, static_cast<std::size_t>(longer * n_samples));
        if (judged(again, "bias.deg_h").verdict != Verdict::undecided) ++s.decided.at(part);
    }
}

// The compensation of the gyro itself; drawn are its half-wave voltage and its magnetic drift.
void own_trial(const AcceptCampaignTask& task, int k, AcceptCampaign& campaign) {
    const Draws draws{task.seed, chance::Cause::noise_gyro, first_trial + static_cast<std::uint64_t>(k)};
    config::Config c;
    for (const std::string& set : {std::string{"run.duration_s=1800"},
                                   fmt::format("run.seed={}", task.seed * 100000 + static_cast<std::uint64_t>(k)),
                                   std::string{"motion.kind=rest"}, std::string{"drift.magnetic_thermal_arcsec_s=0"},
                                   fmt::format("gyro.bias_hz={}", draws.of("bias frequency").within(58e3, 62e3)),
                                   fmt::format("piezo.half_wave_v={}", draws.of("half wave").within(38.0, 42.0)),
                                   fmt::format("drift.magnetic_arcsec_s={}", draws.of("magnetic").within(0.4, 1.0))})
        config::apply_set(c, set);
    const std::string path = task.folder + "/raw.csv";
    logs::RawWriter log{path, config::to_settings(c), true, logs::all_raw_columns, {}};
    (void)study::run({.config = c,
                      .variants = std::vector<std::string>{},
                      .has_figures = false,
                      .on_record = [&](const core::HalfRecord& half, const core::LightSamples&) { log.write(half); }});
    log.close();
    const double half_wave = c.piezo.half_wave_v, magnetic = c.drift.magnetic_arcsec_s;
    // Limits two uncertainties within and beyond, by turns.
    const double side = k % 20 == 0 ? 1.0 : -1.0;
    const double max_v = half_wave + 0.02 * side, max_drift = magnetic + 0.06 * side;
    const acceptance::Acceptance test = tested(
        task.folder, "files = [\"raw.csv\"]\n",
        fmt::format("\"half_wave.v\" = {{ max = {} }}\n\"magnetic_drift.deg_h\" = {{ max = {} }}\n", max_v, max_drift));
    score(judged(test, "half_wave.v"), half_wave, max_v, campaign.quantities["half_wave.v"]);
    score(judged(test, "magnetic_drift.deg_h"), magnetic, max_drift, campaign.quantities["magnetic_drift.deg_h"]);
    // Without limits: what the error of each is.
    for (const auto& [name, truth] :
         {std::pair{"bias.deg_h", c.drift.nonmagnetic_arcsec_s}, std::pair{"bias_frequency.hz", c.gyro.bias_hz},
          std::pair{"chi.per_lambda2", c.gyro.bias_chi}}) {
        const acceptance::Judged& q = judged(test, name);
        VerdictScore& s = campaign.quantities[fmt::format("{} of own logs", name)];
        if (!q.value.determined) continue;
        ++s.known;
        s.squares += std::pow((q.value.value - truth) / q.value.uncertainty, 2);
    }
}

// Whether so many wrong ones of n, or more, are no rarer than 1 in 1000 by the binomial law, summed from none on.
bool keeps(int n, int wrong, double risk) {
    double term = 1.0, fewer = 0.0;
    for (int k = 0; k < n; ++k) term *= 1.0 - risk;
    for (int k = 0; k < wrong; ++k) {
        fewer += term;
        term *= (n - k) * risk / ((k + 1) * (1.0 - risk));
    }
    return wrong == 0 || 1.0 - fewer > 1e-3;
}

// Mean square of n normal numbers, beyond which one in 1000 lies on that side (Wilson and Hilferty, 1931).
double chance_of(int n, double side) {
    const double part = 2.0 / (9.0 * n);
    const double root = std::max(0.0, 1.0 - part + 3.09 * side * std::sqrt(part));
    return root * root * root;
}

}  // namespace

bool VerdictScore::is_good(double risk) const {
    const bool errors = known > 0 && mean_square() >= std::min(0.7, chance_of(known, -1.0)) &&
                        mean_square() <= std::max(1.4, chance_of(known, 1.0));
    // More than half before the time, or fewer after it: the even chance is elsewhere.
    const bool times = keeps(predicted, decided.front(), 0.5) && keeps(predicted, predicted - decided.back(), 0.5);
    return keeps(beyond, passed, risk) && keeps(within, failed, risk) && times && errors;
}

bool AcceptCampaign::is_good() const {
    return stopped == faulty &&
           std::ranges::all_of(quantities, [this](const auto& q) { return q.second.is_good(risk); });
}

AcceptCampaign run_accept_campaign(const AcceptCampaignTask& task) {
    AcceptCampaign campaign;
    for (int k = 0; k < task.n_units; ++k) (k % 10 == 0 ? own_trial : foreign_trial)(task, k, campaign);
    return campaign;
}

std::string campaign_text(const AcceptCampaign& campaign) {
    std::string text =
        "| quantity | beyond | passed falsely | within | failed falsely | undecided | measured on | decided at 2/3, 1, "
        "3/2 of the time | "
        "mean square of error/uncertainty |\n|---|---|---|---|---|---|---|---|---|\n";
    for (const auto& [name, s] : campaign.quantities)
        text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {}, {}, {} | {:.2f} of {} |\n", name, s.beyond,
                            s.passed, s.within, s.failed, s.undecided, s.predicted, s.decided[0], s.decided[1],
                            s.decided[2], s.mean_square(), s.known);
    return text + fmt::format("\nLogs that are no measurements: {}, without a verdict {}.\n", campaign.faulty,
                              campaign.stopped);
}

}  // namespace zlg::trials
