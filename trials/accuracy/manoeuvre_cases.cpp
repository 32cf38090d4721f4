#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include <zlg/numeric/parallel.hpp>

#include "manoeuvres.hpp"
#include "parts.hpp"

namespace zlg::trials {
namespace {

struct Base {
    std::string name;
    GyroLaw gyro;
    MotionLaw motion;
};

std::vector<Base> bases(bool quick) {
    std::vector<Base> all;
    for (const char* readout : readouts) {
        const GyroLaw gyro = gyro_of(readout);
        // With the phase at rest the same phases come again and again: the ellipse is learnt at a slow turn.
        const double turn_arcsec_s = gyro.photodiodes.reads ? 15.0 : 0.0;
        all.push_back({fmt::format("rest, {}", readout), gyro, {.rate_arcsec_s = turn_arcsec_s}});
        all.push_back({fmt::format("20.06 Hz, {}", readout), gyro, {.tones = {{20.06, 12000.0}}}});
        if (!quick) all.push_back({fmt::format("5 to 80 Hz, {}", readout), gyro, {.bands = {{5.0, 80.0, 300.0}}}});
    }
    return all;
}

struct Kind {
    std::string name;
    Manoeuvre manoeuvre;
};

const char* name_of(ManoeuvreLaw law) {
    constexpr std::array names{"ramp", "linear", "exponential", "pulse"};
    return names[static_cast<std::size_t>(law)];
}

const char* name_of(ManoeuvrePlace place) {
    constexpr std::array names{"ended before", "before", "in", "after"};
    return names[static_cast<std::size_t>(place)];
}

constexpr double arcsec_per_degree = 3600.0;

std::vector<Kind> kinds(bool quick) {
    std::vector<Kind> all{{"", {.rate_arcsec_s = 0.0}}};
    const auto add = [&](ManoeuvreLaw law, double rate_deg_s, double duration_s) {
        for (const auto place :
             {ManoeuvrePlace::ended, ManoeuvrePlace::before, ManoeuvrePlace::in, ManoeuvrePlace::after})
            all.push_back({fmt::format("{} to {} deg/s in {:.0f} ms, {}", name_of(law), rate_deg_s, 1e3 * duration_s,
                                       name_of(place)),
                           {.law = law,
                            .place = place,
                            .rate_arcsec_s = arcsec_per_degree * rate_deg_s,
                            .duration_s = duration_s}});
    };
    if (quick) {
        add(ManoeuvreLaw::ramp, 10.0, 0.02);
        for (const double duration_s : {0.05, 0.3}) add(ManoeuvreLaw::ramp, 10.0, duration_s);
        return all;
    }
    for (const double rate : {1.0, 10.0, 100.0})
        for (const double duration_s : {0.02, 0.05, 0.1, 0.3}) add(ManoeuvreLaw::ramp, rate, duration_s);
    for (const auto law : {ManoeuvreLaw::linear, ManoeuvreLaw::exponential, ManoeuvreLaw::pulse})
        for (const double duration_s : {0.05, 0.1}) add(law, 10.0, duration_s);
    return all;
}

const MotionLaw ten_hertz{.tones = {{10.0, 12000.0}}};
const MotionLaw twenty_hertz{.tones = {{20.0, 12000.0}}};

// The motion before, and those of which one follows.
struct Change {
    Base base;
    std::vector<Kind> kinds;
};

Kind kind_to(const char* name, const MotionLaw& next) {
    return {fmt::format("to {}", name), {.rate_arcsec_s = 0.0, .next = next}};
}

std::vector<Change> changes(bool quick) {
    const Kind to_rest = kind_to("rest", {});
    const Kind to_ten = kind_to("10 Hz", ten_hertz);
    const Kind to_twenty = kind_to("20 Hz", twenty_hertz);
    std::vector<Change> all;
    for (const char* readout : readouts) {
        const GyroLaw gyro = gyro_of(readout);
        const auto add = [&](const char* name, const MotionLaw& motion, std::vector<Kind> kinds) {
            all.push_back({{fmt::format("{}, {}", name, readout), gyro, motion}, std::move(kinds)});
        };
        add("10 Hz", ten_hertz, {to_twenty});
        add("20 Hz", twenty_hertz, {to_ten, to_rest});
        if (!quick) add("rest", {.rate_spread_arcsec_s = 15.0}, {to_twenty});
    }
    return all;
}

// Of one gyro: few, for at rest its counter shows the same fraction before every gap.
constexpr int gaps_of_trial = 5;

}  // namespace

double over_best_polynomial(const ManoeuvreFigures& figures) {
    double best = std::numeric_limits<double>::infinity();
    for (const MethodFigures& m : figures.methods)
        if (m.of_paper) best = std::min(best, m.whole.rms_arcsec);
    return find_method(figures.methods, method_name::automatic)->whole.rms_arcsec / best;
}

namespace {

std::vector<AccuracyMethod> compared_methods(const GyroLaw& gyro) {
    return methods_for(config_of(gyro),
                       {method_name::automatic, method_name::constant, method_name::linear, method_name::quadratic});
}

// The estimate with all of its bank, and without one member after the other.
std::vector<AccuracyMethod> reduced_banks(const GyroLaw& gyro) {
    const AccuracyMethod whole = methods_for(config_of(gyro), {method_name::automatic}).front();
    std::vector<AccuracyMethod> all{whole};
    for (std::size_t k = 0; k < whole.bank.size(); ++k) {
        all.push_back(whole);
        all.back().bank.erase(all.back().bank.begin() + static_cast<std::ptrdiff_t>(k));
    }
    return all;
}

// By part of the trials, then by kind, method and gap.
using Parts = std::vector<std::vector<std::vector<std::vector<SwitchError>>>>;

ManoeuvreFigures figures_of_kind(const Base& base, const Kind& kind, std::size_t k,
                                 const std::vector<AccuracyMethod>& methods, const Parts& parts) {
    ManoeuvreFigures f{.base = base.name, .manoeuvre = kind.name, .methods = {}};
    for (std::size_t m = 0; m < methods.size(); ++m) {
        std::vector<SwitchError> of_kind;
        for (const auto& part : parts) of_kind.insert(of_kind.end(), part[k][m].begin(), part[k][m].end());
        f.methods.push_back(
            {.method = methods[m].name, .of_paper = is_of_paper(methods[m].name), .whole = figures_of(of_kind)});
    }
    return f;
}

using MethodsOf = std::vector<AccuracyMethod>(const GyroLaw&);

// How much of the motion each trial learns, and how many gaps it then has.
struct Learning {
    std::int64_t ticks = 3000;
    int gaps = gaps_of_trial;
};

std::vector<ManoeuvreFigures> measure(const std::vector<Change>& all, MethodsOf& methods_of, const Learning& learning,
                                      int gaps, std::uint64_t seed, int threads) {
    const auto n_parts = static_cast<std::size_t>((gaps + learning.gaps - 1) / learning.gaps);
    std::vector<Parts> errors(all.size(), Parts(n_parts));
    numeric::in_parallel(all.size() * n_parts, threads, [&](std::size_t job) {
        const Change& of = all[job / n_parts];
        ManoeuvreTrial trial{.gyro = of.base.gyro, .motion = of.base.motion, .manoeuvres = {}, .gaps = learning.gaps};
        trial.learn_ticks = learning.ticks;
        trial.seed = (seed << 40) + job;
        for (const Kind& k : of.kinds) trial.manoeuvres.push_back(k.manoeuvre);
        errors[job / n_parts][job % n_parts] = run_manoeuvres(trial, methods_of(of.base.gyro));
    });
    std::vector<ManoeuvreFigures> figures;
    for (std::size_t b = 0; b < all.size(); ++b)
        for (std::size_t k = 0; k < all[b].kinds.size(); ++k)
            figures.push_back(
                figures_of_kind(all[b].base, all[b].kinds[k], k, methods_of(all[b].base.gyro), errors[b]));
    return figures;
}

}  // namespace

std::vector<ManoeuvreFigures> measure_manoeuvres(int gaps, bool quick, std::uint64_t seed, int threads) {
    std::vector<Change> all;
    for (Base& base : bases(quick)) all.push_back({std::move(base), kinds(quick)});
    return measure(all, compared_methods, {}, gaps, seed + (std::uint64_t{7} << 24), threads);
}

std::vector<ManoeuvreFigures> measure_changes(int gaps, bool quick, std::uint64_t seed, int threads) {
    return measure(changes(quick), compared_methods, {}, gaps, seed + (std::uint64_t{11} << 24), threads);
}

std::vector<ManoeuvreFigures> measure_members(int gaps, std::uint64_t seed, int threads) {
    std::vector<Change> known;
    std::vector<Change> first;
    for (const Base& base : bases(true)) {
        known.push_back({base, kinds(true)});
        first.push_back({base, {{"first gap", {.rate_arcsec_s = 0.0}}}});
    }
    for (const char* readout : readouts)
        first.push_back(
            {{fmt::format("flat to 20 Hz, {}", readout), gyro_of(readout), {.bands = {{0.0, 20.0, 8485.0}}}},
             {{"first gap", {.rate_arcsec_s = 0.0}}}});
    std::vector<ManoeuvreFigures> all = measure(known, reduced_banks, {}, gaps, seed, threads);
    for (const std::int64_t ticks : {0, 40}) {
        const auto of_first = measure(first, reduced_banks, {.ticks = ticks, .gaps = 1}, gaps, seed + 1, threads);
        all.insert(all.end(), of_first.begin(), of_first.end());
    }
    return all;
}

}  // namespace zlg::trials
