#include <zlg/trials/accept_campaign.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include <zlg/acceptance/accept.hpp>
#include <zlg/chance/draw.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/study/run.hpp>

namespace zlg::trials {
namespace {

using acceptance::Verdict;
using chance::Draw;
using chance::Draws;

constexpr std::uint64_t first_trial = std::uint64_t{1} << 40;  // beyond those of the noise campaign
constexpr std::size_t n_samples = 4096;
constexpr int n_stages = 41, stage_s = 32;
constexpr double largest_rate = 10.0;  // deg/s

struct Unit {
    double bias = 0.0;
    double walk = 1.0;  // arcsec/sqrt(s), and deg/h of a sample
    double rate_walk = 0.0;
    double scale_ppm = 0.0, bend_ppm = 0.0;
    double warming = 0.0, warming_s = 100.0;
    double per_c = 0.0, per_mt = 0.0;
    std::size_t order = 0;  // of the rates of the table: mixed, rising, up and down
    bool filtered = false;
    int fault = 0;  // 0: none
};

// What is to be judged: its true value, about which the limit is drawn in rough errors (for what is never below 0 by a
// factor), and what values of such records scatter by; 0: by what they say.
struct Case {
    const char* name;
    double truth, error, scatter;
    bool is_factor;
    double limit = 0.0;
};

// Well within, near or well beyond a limit, in errors; near is farther than what stays undecided, so that it tells
// nothing of the side.
double place(Draw draw) { return std::array{-20.0, draw.within(-6.0, 6.0), 20.0}[draw.below(3)]; }

void draw_limits(std::vector<Case>& cases, const Draws& draws, std::size_t bad) {
    for (std::size_t k = 0; k < cases.size(); ++k) {
        Case& c = cases[k];
        const double at = k == 0 || k == bad ? place(draws.of(c.name)) : -20.0;
        c.limit = c.is_factor ? c.truth * core::maths::exp(-c.error * at) : c.truth - c.error * at;
    }
}

Unit unit_of(const Draws& draws, int k) {
    Unit u;
    u.walk = draws.of("white").within_log(0.1, 10.0);
    // Where its Allan deviation crosses that of the white noise, in parts of the record.
    if (k % 2 == 0) u.rate_walk = u.walk * std::sqrt(3.0) / (n_samples / draws.of("walk").within_log(8.0, 64.0));
    u.filtered = k % 3 == 0;
    u.bias = 50.0 * u.walk * draws.of("bias").within(-1.0, 1.0);
    u.scale_ppm = draws.of("scale").within(-500.0, 500.0);
    u.bend_ppm = u.walk * draws.of("bend").within_log(1.0, 100.0);
    u.order = draws.of("order").below(3);
    u.warming = 10.0 * u.walk;
    u.warming_s = draws.of("warming").within(150.0, 900.0);
    u.per_c = u.walk * draws.of("temperature").within(-1.0, 1.0);
    u.per_mt = u.walk * draws.of("field").within(-1.0, 1.0);
    if (k % 10 == 9) u.fault = 1 + (k / 10) % 4;
    return u;
}

// The time at which the mean over the quarter of the time around it comes into the band, the noise of a sample, about
// 0.
double settling_of(const Unit& u) {
    const auto off = [&u](double t) {
        const double before = core::maths::exp(-0.875 * t / u.warming_s),
                     after = core::maths::exp(-1.125 * t / u.warming_s);
        return u.warming * (before - after) * 4.0 * u.warming_s / t;
    };
    double t = 1.0;
    while (off(t) > u.walk) t += 1.0;
    return t;
}

std::vector<Case> cases_of(const Unit& u) {
    // White noise of a stage, and of a walk over the table, by the order of its rates, what is about the line and what
    // its slope takes: with the covariance W of the stages tr(R W)/(n - 2) and a W a.
    constexpr std::array about{0.1699, 0.0659, 0.1446}, in_slope{0.0028, 0.2856, 0.0716};
    const double n = n_samples, to_ppm = 1e6 / (3600.0 * largest_rate);
    const double walked = u.rate_walk * std::sqrt(1.0 * stage_s * n_stages);
    const double white = core::maths::hypot(u.bend_ppm, to_ppm * u.walk / std::sqrt(1.0 * stage_s));
    const double bend = core::maths::hypot(white, to_ppm * walked * std::sqrt(about.at(u.order)));
    const double scale = core::maths::hypot(white * std::sqrt(3.0 * (n_stages - 1.0) / (n_stages + 1.0) / n_stages),
                                            to_ppm * walked * std::sqrt(in_slope.at(u.order)));
    const double mean = std::sqrt(u.walk * u.walk / n + u.rate_walk * u.rate_walk * n / 3.0);
    const double slope = core::maths::hypot(0.5 * u.walk / std::sqrt(n), 0.03 * u.rate_walk * std::sqrt(n));
    std::vector<Case> cases{{"bias.deg_h", u.bias, mean, mean, false},
                            {"angle_random_walk.deg_sqrt_h", u.walk / 60.0, 0.015, 0.0, true},
                            {"scale_factor.ppm", u.scale_ppm, scale, scale, false},
                            {"scale_nonlinearity.ppm", bend, 1.0 / std::sqrt(2.0 * n_stages - 4.0), 0.0, true},
                            {"warm_up.s", settling_of(u), 0.05, 0.0, true},
                            {"bias_temperature.deg_h_c", u.per_c, slope, 0.0, false},
                            {"magnetic_sensitivity.deg_h_mt", u.per_mt, mean, mean / std::sqrt(2.0), false}};
    if (u.rate_walk > 0.0) cases.push_back({"rate_random_walk.deg_h_sqrt_h", 60.0 * u.rate_walk, 0.15, 0.0, true});
    return cases;
}

// Noise about what `rate` says. The low pass is a mean over two samples; the walk begins at 0.
template <class Rate>
std::vector<double> record_of(const Unit& u, const Draws& draws, const std::string& name, std::size_t n, Rate rate) {
    Draw white = draws.of(name), steps = draws.of("walk of the rate, " + name);
    std::vector<double> rates(n);
    double walk = 0.0, last = white.normal();
    for (std::size_t k = 0; k < n; ++k) {
        const double next = white.normal(), step = u.rate_walk * steps.normal();
        rates[k] = rate(k) + walk + 0.5 * step + u.walk * (u.filtered ? 0.5 * (next + last) : next);
        walk += step;
        last = next;
    }
    return rates;
}

std::vector<double> still_record(const Unit& u, const Draws& draws, std::size_t n) {
    std::vector<double> rates = record_of(u, draws, "static", n, [&u](std::size_t) { return u.bias; });
    const double middle = u.bias, at = rates[n / 2];
    for (std::size_t k = 0; k < n; ++k) {
        if (u.fault == 1) rates[k] = middle;                                                              // dead
        if (u.fault == 2 && k > n / 2 && k < n / 2 + 400) rates[k] = at;                                  // held
        if (u.fault == 3) rates[k] = std::clamp(rates[k], middle - 0.5 * u.walk, middle + 0.5 * u.walk);  // clipped
        if (u.fault == 4) rates[k] = rates[k - k % 2];                                                    // doubled
    }
    return rates;
}

// Of a triangle from 20 C over 40 C back.
double temperature_at(std::size_t k) { return 40.0 - 20.0 * std::abs(static_cast<double>(k) / (n_samples / 2) - 1.0); }

// Plan and logs of one unit.
class Folder {
public:
    explicit Folder(std::string at) : at_{std::move(at)} {}

    void add_still(const Unit& u, const Draws& draws, std::size_t n) { add("static", "", still_record(u, draws, n)); }

    void add_others(const Unit& u, const Draws& draws) {
        std::string stages;
        std::vector<double> rates, bends;
        Draw bend = draws.of("bends");
        for (int k = 0; k < n_stages; ++k) {
            const int at = std::array{8 * k % n_stages, k, std::min(2 * k, 2 * n_stages - 1 - 2 * k)}.at(u.order);
            rates.push_back(largest_rate * (2.0 * at / (n_stages - 1) - 1.0));
            bends.push_back(3600.0 * (rates.back() * u.scale_ppm + largest_rate * u.bend_ppm * bend.normal()) * 1e-6);
            stages += fmt::format("{{ from_s = {}, to_s = {}, rate_deg_s = {} }}, ", stage_s * k, stage_s * (k + 1),
                                  rates.back());
        }
        Unit by = u;
        const auto log = [&](const char* kind, const std::string& more, std::size_t n, auto rate) {
            add(kind, more, record_of(by, draws, fmt::format("{} {}", kind, more.substr(0, 20)), n, rate));
        };
        log("rate_table", fmt::format("stages = [{}]\n", stages), stage_s * n_stages,
            [&](std::size_t k) { return 3600.0 * rates[k / stage_s] + bends[k / stage_s]; });
        by.rate_walk = 0.0;  // of this definition slow noise is no error
        log("warm_up", "", n_samples,
            [&](std::size_t k) { return u.warming * core::maths::exp(-(static_cast<double>(k) + 0.5) / u.warming_s); });
        by = u;
        log("temperature", "temperature_c = 2\n", n_samples,
            [&](std::size_t k) { return u.per_c * (temperature_at(k) - 30.0); });
        for (const int field : {-1, 0, 1})
            log("magnetic", fmt::format("field_mt = {}\n", field), n_samples,
                [&](std::size_t) { return u.per_mt * field; });
        plan_ += fmt::format("[accept]\nwarm_up_band_deg_h = {}\n", u.walk);
    }

    void add_run(const char* kind, const std::string& file, const std::string& more) {
        plan_ += fmt::format("[[run]]\nkind = \"{}\"\nfiles = [\"{}\"]\n{}", kind, file, more);
    }

    [[nodiscard]] acceptance::Acceptance tested(const std::vector<Case>& cases) const {
        std::ofstream plan{at_ + "/plan.toml"};
        plan << plan_ << "[limits]\n";
        for (const Case& c : cases) plan << fmt::format("\"{}\" = {{ max = {} }}\n", c.name, c.limit);
        plan.close();
        return acceptance::accept({.plan = at_ + "/plan.toml", .said = {}});
    }

    [[nodiscard]] std::string path(const std::string& file) const { return at_ + "/" + file; }

    void add(const char* kind, const std::string& more, const std::vector<double>& rates) {
        const std::string file = fmt::format("{}.csv", n_logs_++);
        std::ofstream log{path(file)};
        for (std::size_t k = 0; k < rates.size(); ++k) log << fmt::format("{},{}\n", rates[k], temperature_at(k));
        add_run(kind, file, "column = 1\ntime = \"none\"\nholds = \"rate\"\nunit = \"deg/h\"\nrate_hz = 1\n" + more);
    }

private:
    std::string at_, plan_ = "[unit]\nserial = \"trial\"\n";
    int n_logs_ = 0;
};

const acceptance::Judged& judged(const acceptance::Acceptance& test, const char* name) {
    return *std::ranges::find_if(test.quantities, [&](const acceptance::Judged& q) { return q.value.name == name; });
}

// Over values that scatter about the truth, eight equally probable ones of a normal law, with the error that is stated.
double chance_of_none(const acceptance::Judged& q, const Case& c, double risk) {
    acceptance::Value v = q.value;
    int undecided = 0;
    for (const double z : {0.1573, 0.4888, 0.8871, 1.5341})
        for (const double side : {-1.0, 1.0}) {
            v.value = c.truth + side * z * (c.scatter > 0.0 ? c.scatter : v.uncertainty);
            undecided += acceptance::judge(v, q.limit, risk).verdict == Verdict::undecided ? 1 : 0;
        }
    return undecided / 8.0;
}

void score(const acceptance::Acceptance& test, const std::vector<Case>& cases, const char* of,
           AcceptCampaign& campaign) {
    for (const Case& c : cases) {
        const acceptance::Judged& q = judged(test, c.name);
        VerdictScore& s = campaign.quantities[c.name + std::string{of}];
        if (!q.value.determined) {
            ++s.open;
            continue;
        }
        const bool beyond = c.truth > c.limit;
        (beyond ? s.beyond : s.within) += 1;
        if (beyond && q.verdict == Verdict::pass) ++s.passed;
        if (!beyond && q.verdict == Verdict::fail) ++s.failed;
        if (q.value.value == 0.0) continue;  // a term that was not found has a bound, and no scatter
        if (q.verdict == Verdict::undecided) ++s.undecided;
        s.foreseen += chance_of_none(q, c, campaign.risk);
        ++s.known;
        s.squares += std::pow((q.value.value - c.truth) / q.value.uncertainty, 2);
    }
}

void foreign_trial(const AcceptCampaignTask& task, int k, AcceptCampaign& campaign) {
    const auto trial = first_trial + static_cast<std::uint64_t>(k);
    const Draws draws{task.seed, chance::Cause::noise_gyro, trial},
        records{task.seed, chance::Cause::noise_record, trial};
    const Unit u = unit_of(draws, k);
    std::vector<Case> cases = cases_of(u);
    draw_limits(cases, draws, 1 + draws.of("bad").below(cases.size() - 1));
    Folder folder{task.folder};
    folder.add_still(u, records, n_samples);
    folder.add_others(u, records);
    const acceptance::Acceptance test = folder.tested(cases);
    const acceptance::Judged& bias = judged(test, "bias.deg_h");
    if (u.fault != 0) {
        ++campaign.faulty;
        if (bias.verdict == Verdict::not_determined) ++campaign.stopped;
        return;
    }
    score(test, cases, "", campaign);
    if (bias.verdict != Verdict::undecided || !bias.more_hours) return;
    VerdictScore& s = campaign.quantities[cases.front().name];
    ++s.predicted;
    for (std::size_t part = 0; part < s.decided.size(); ++part) {
        const double longer = 1.0 + VerdictScore::parts.at(part) * *bias.more_hours / bias.value.hours;
        Folder again{task.folder};
        again.add_still(u, records, static_cast<std::size_t>(longer * n_samples));
        if (judged(again.tested({cases.front()}), cases.front().name).verdict != Verdict::undecided)
            ++s.decided.at(part);
    }
}

// The compensation of the gyro itself. Every second one warms.
void own_trial(const AcceptCampaignTask& task, int k, AcceptCampaign& campaign) {
    const Draws draws{task.seed, chance::Cause::noise_gyro, first_trial + static_cast<std::uint64_t>(k)};
    const double growth = k % 20 == 0 ? draws.of("growth").within(-1.0, 1.0) : 0.0;
    config::Config c;
    for (const std::string& set :
         {std::string{"run.duration_s=1800"},
          fmt::format("run.seed={}", task.seed * 100000 + static_cast<std::uint64_t>(k)),
          std::string{"motion.kind=rest"}, fmt::format("drift.magnetic_thermal_arcsec_s={}", growth),
          fmt::format("drift.thermal_time_s={}", draws.of("time").within_log(200.0, 2e4)),
          fmt::format("gyro.bias_hz={}", draws.of("bias frequency").within(58e3, 62e3)),
          fmt::format("piezo.half_wave_v={}", draws.of("half wave").within(38.0, 42.0)),
          fmt::format("drift.magnetic_arcsec_s={}", draws.of("magnetic").within(0.4, 1.0))})
        config::apply_set(c, set);
    Folder folder{task.folder};
    logs::RawWriter log{folder.path("raw.csv"), config::to_settings(c), true, logs::all_raw_columns, {}};
    (void)study::run({.config = c,
                      .variants = std::vector<std::string>{},
                      .has_figures = false,
                      .on_record = [&](const core::HalfRecord& half, const core::LightSamples&) { log.write(half); }});
    log.close();
    std::vector<Case> cases{{"half_wave.v", c.piezo.half_wave_v, 0.005, 0.0, false},
                            {"magnetic_drift.deg_h", c.drift.magnetic_arcsec_s, 0.02, 0.0, false},
                            {"bias_frequency.hz", c.gyro.bias_hz, 4.0, 0.0, false},
                            {"chi.per_lambda2", c.gyro.bias_chi, 0.01, 0.0, false},
                            {"bias.deg_h", c.drift.nonmagnetic_arcsec_s, 0.005, 0.0, false}};
    draw_limits(cases, draws, 1 + draws.of("bad").below(cases.size() - 1));
    folder.add_run("static", "raw.csv", "");
    score(folder.tested(cases), cases, " of own logs", campaign);
}

// White noise and flicker of the spectrum B^2/(2 pi f), by fractional differences of white noise (Kasdin, Proc. IEEE
// 83, 1995) that began a record before; its floor is 1.5 to 3 times the white noise at 1/32 of the record.
void flicker_trial(const AcceptCampaignTask& task, int k, AcceptCampaign& campaign) {
    const auto trial = first_trial + static_cast<std::uint64_t>(k);
    const Draws draws{task.seed, chance::Cause::noise_gyro, trial},
        records{task.seed, chance::Cause::noise_record, trial};
    const double white = draws.of("white").within_log(0.1, 10.0);
    const double b = white * std::sqrt(32.0 / n_samples) * draws.of("floor").within(1.5, 3.0) / 0.664;
    Draw noise = records.of("static"), before = records.of("flicker");
    std::vector<double> response{1.0}, driving, rates;
    for (double j = 1.0; j < 2.0 * n_samples; j += 1.0) response.push_back(response.back() * (j - 0.5) / j);
    while (driving.size() < response.size()) {
        driving.insert(driving.begin(), before.normal());
        if (driving.size() > n_samples)
            rates.push_back(white * noise.normal() +
                            b * std::inner_product(driving.begin(), driving.end(), response.begin(), 0.0));
    }
    std::vector<Case> cases{{"bias_instability.deg_h", b, 0.1, 0.0, true},
                            {"angle_random_walk.deg_sqrt_h", white / 60.0, 0.015, 0.0, true}};
    draw_limits(cases, draws, 1);
    Folder folder{task.folder};
    folder.add("static", "", rates);
    score(folder.tested(cases), cases, " with flicker", campaign);
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
    // As many without a verdict as foreseen, but for a factor and the chance of independent events.
    const auto chance = [this](double part) { return 3.0 * std::sqrt(part * foreseen + 1.0); };
    const bool share = undecided <= 1.5 * foreseen + chance(1.5) && undecided >= foreseen / 1.5 - chance(1.0 / 1.5);
    return keeps(beyond, passed, risk) && keeps(within, failed, risk) && times && errors && share;
}

bool AcceptCampaign::is_good() const {
    return stopped == faulty &&
           std::ranges::all_of(quantities, [this](const auto& q) { return q.second.is_good(risk); });
}

AcceptCampaign run_accept_campaign(const AcceptCampaignTask& task) {
    AcceptCampaign campaign;
    for (int k = 0; k < task.n_units; ++k)
        (k % 10 == 0 ? own_trial : k % 10 == 5 ? flicker_trial : foreign_trial)(task, k, campaign);
    return campaign;
}

std::string campaign_text(const AcceptCampaign& campaign) {
    std::string text =
        "| quantity | beyond | passed falsely | within | failed falsely | undecided, foreseen | not determined | "
        "measured on | decided at 2/3, 1, "
        "3/2 of the time | "
        "mean square of error/uncertainty |\n|---|---|---|---|---|---|---|---|---|---|\n";
    for (const auto& [name, s] : campaign.quantities)
        text += fmt::format("| {} | {} | {} | {} | {} | {}, {:.1f} | {} | {} | {}, {}, {} | {:.2f} of {} |\n", name,
                            s.beyond, s.passed, s.within, s.failed, s.undecided, s.foreseen, s.open, s.predicted,
                            s.decided[0], s.decided[1], s.decided[2], s.mean_square(), s.known);
    return text + fmt::format("\nLogs that are no measurements: {}, without a verdict {}.\n", campaign.faulty,
                              campaign.stopped);
}

}  // namespace zlg::trials
