#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>

#include "verdict.hpp"

namespace zlg::choice {
namespace {

constexpr std::int64_t confirming_gyros = 24;
constexpr int steps = 7;  // of the bisection: 2^-7 of the way, in the logarithm
constexpr double furthest = 100.0;

// A constant of the gyro, and what a factor on it means.
struct Constant {
    const char* name;
    std::vector<std::string> keys;
    double (*value)(const config::Config&);
    void (*scale)(config::Config&, double factor);
    bool is_to_rise = false;
};

const std::vector<Constant>& constants() {
    using C = config::Config;
    static const std::vector<Constant> all{{"the miss",
                                            {"perimeter.miss_lambda"},
                                            [](const C& c) { return c.perimeter.miss_lambda; },
                                            [](C& c, double f) { c.perimeter.miss_lambda *= f; }},
                                           {"the light noise",
                                            {"gyro.light_noise_lambda"},
                                            [](const C& c) { return c.gyro.light_noise_lambda; },
                                            [](C& c, double f) { c.gyro.light_noise_lambda *= f; }},
                                           {"the magnetic sensitivity",
                                            {"drift.magnetic_arcsec_s", "drift.magnetic_thermal_arcsec_s"},
                                            [](const C& c) { return c.drift.magnetic_arcsec_s; },
                                            [](C& c, double f) {
                                                c.drift.magnetic_arcsec_s *= f;
                                                c.drift.magnetic_thermal_arcsec_s *= f;
                                            }},
                                           {"the thermal time",
                                            {"drift.thermal_time_s"},
                                            [](const C& c) { return c.drift.thermal_time_s; },
                                            [](C& c, double f) { c.drift.thermal_time_s *= f; },
                                            true},
                                           {"the tick",
                                            {"gyro.tick_s"},
                                            [](const C& c) { return c.gyro.tick_s; },
                                            [](C& c, double f) { c.gyro.tick_s *= f; }},
                                           {"the count",
                                            {"gyro.scale_arcsec"},
                                            [](const C& c) { return c.gyro.scale_arcsec; },
                                            [](C& c, double f) {
                                                c.gyro.scale_arcsec *= f;
                                                c.gyro.bias_hz /= f;
                                            }},
                                           {"the random walk",
                                            {"drift.random_walk_arcsec_sqrt_s"},
                                            [](const C& c) { return c.drift.random_walk_arcsec_sqrt_s; },
                                            [](C& c, double f) { c.drift.random_walk_arcsec_sqrt_s *= f; }}};
    return all;
}

class Changed {
public:
    Changed(const Task& task, const Candidate& candidate, const Constant& constant)
        : task_{task}, candidate_{candidate}, constant_{constant} {}

    [[nodiscard]] Population population(double factor) const {
        return {task_.requirement, task_.requirement.base.run.seed, confirming_gyros,
                [this, factor](config::Config& c) { constant_.scale(c, factor); }};
    }

    // The interval with the best chance.
    [[nodiscard]] std::pair<double, Candidate> best(double factor) const {
        const Population changed = population(factor);
        Forecast forecast{changed, task_.threads, task_.is_stopped};
        std::pair<double, Candidate> found{-1.0, candidate_};
        for (const Candidate& c : candidates(task_.requirement, candidate_.method)) {
            const double chance = forecast.chance(c);
            if (chance > found.first) found = {chance, c};
        }
        return found;
    }

private:
    const Task& task_;
    const Candidate& candidate_;
    const Constant& constant_;
};

std::string sentence_of(const Constant& c, const Need& need) {
    if (!need.is_enough)
        return fmt::format("No change of {} alone is enough, down or up to {:.0f} times.", c.name, furthest);
    return fmt::format("{} from {} to {} ({}): {} of {} gyros then meet it.", c.name, report::short_number(need.from),
                       report::short_number(need.to), fmt::join(need.keys, " and "),
                       std::llround(need.share * static_cast<double>(need.tried)), need.tried);
}

Need need_of(const Task& task, const Candidate& candidate, const Constant& constant) {
    const config::Config gyro = with(task.requirement.base, candidate);
    Need need{.keys = constant.keys, .from = constant.value(gyro)};
    need.to = need.from;
    const Changed changed{task, candidate, constant};
    const double sign = constant.is_to_rise ? 1.0 : -1.0;
    const auto factor = [&](double way) { return std::pow(furthest, sign * way); };
    const double confidence = task.requirement.confidence;
    if (need.from != 0.0 && changed.best(factor(1.0)).first >= confidence) {
        double too_little = 0.0, enough = 1.0;
        for (int k = 0; k < steps; ++k) {
            const double middle = 0.5 * (too_little + enough);
            (changed.best(factor(middle)).first >= confidence ? enough : too_little) = middle;
        }
        need.is_enough = true;
        need.to = need.from * factor(enough);
        const Population population = changed.population(factor(enough));
        Evaluation e{changed.best(factor(enough)).second, {}};
        Tester{task, population}.extend(e, confirming_gyros, std::numeric_limits<double>::infinity(), {});
        need.tried = confirming_gyros;
        need.share = e.share(task.requirement.limit_arcsec());
    }
    need.sentence = sentence_of(constant, need);
    need.sentence.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(need.sentence.front())));
    return need;
}

}  // namespace

std::vector<Need> needs(const Task& task, const Candidate& candidate) {
    std::vector<Need> all;
    for (const Constant& constant : constants()) all.push_back(need_of(task, candidate, constant));
    return all;
}

}  // namespace zlg::choice
