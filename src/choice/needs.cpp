#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>

#include "verdict.hpp"

namespace zlg::choice {
namespace {

constexpr std::int64_t confirming_gyros = 24;
constexpr double furthest = 100.0;
// Of the way to the furthest factor, in the logarithm: of 1.8, each of which tries switches, and of 1.33.
constexpr double coarse_step = 0.125, fine_step = 0.0625;
constexpr int halvings = 4;  // of that step

// A constant of the gyro, and what else goes with a factor on it.
struct Constant {
    const char* name;
    std::vector<std::string> keys;
    double& (*of)(config::Config&);
    void (*rest)(config::Config&, double factor) = nullptr;
};

const std::vector<Constant>& constants() {
    using C = config::Config;
    static const std::vector<Constant> all{
        {"the miss", {"perimeter.miss_lambda"}, [](C& c) -> double& { return c.perimeter.miss_lambda; }},
        {"the light noise", {"gyro.light_noise_lambda"}, [](C& c) -> double& { return c.gyro.light_noise_lambda; }},
        {"the magnetic sensitivity",
         {"drift.magnetic_arcsec_s", "drift.magnetic_thermal_arcsec_s"},
         [](C& c) -> double& { return c.drift.magnetic_arcsec_s; },
         [](C& c, double f) { c.drift.magnetic_thermal_arcsec_s *= f; }},
        {"the thermal time", {"drift.thermal_time_s"}, [](C& c) -> double& { return c.drift.thermal_time_s; }},
        {"the tick",
         {"gyro.tick_s", "switching.gap_ticks", "drift.random_walk_arcsec_sqrt_s"},
         [](C& c) -> double& { return c.gyro.tick_s; },
         [](C& c, double f) { keep_with_tick(c, f); }},
        {"the count",
         {"gyro.scale_arcsec", "gyro.bias_hz"},
         [](C& c) -> double& { return c.gyro.scale_arcsec; },
         [](C& c, double f) { c.gyro.bias_hz /= f; }},
        {"the random walk",
         {"drift.random_walk_arcsec_sqrt_s"},
         [](C& c) -> double& { return c.drift.random_walk_arcsec_sqrt_s; }},
    };
    return all;
}

// By which factor a constant would have to change in one direction, and the gyros that say so.
struct Enough {
    double factor = 1.0;
    Evaluation trials;
};

class Changed {
public:
    // as_it_is  of the gyros without a change; outlives it, as all do.
    Changed(const Task& task, const Candidate& candidate, const Constant& constant, Forecast& as_it_is)
        : task_{task}, candidate_{candidate}, constant_{constant}, as_it_is_{as_it_is} {}

    // Nearest by the closed forms, then further until the gyros agree. direction  1 or -1.
    [[nodiscard]] std::optional<Enough> enough(double direction) const {
        const auto factor = [&](double way) { return std::pow(furthest, direction * way); };
        const double step = is_of_drift() ? fine_step : coarse_step;
        double way = step;
        while (way <= 1.0 && !is_likely(factor(way))) way += step;
        if (way > 1.0) return std::nullopt;
        double too_little = way - step;
        for (int halving = 0; halving < halvings; ++halving) {
            const double middle = 0.5 * (too_little + way);
            (is_likely(factor(middle)) ? way : too_little) = middle;
        }
        for (; way <= 1.0; way += step) {
            const Enough found{factor(way), tried(factor(way))};
            if (found.trials.share(task_.requirement.limit_arcsec()) >= task_.requirement.confidence) return found;
        }
        return std::nullopt;
    }

private:
    // Which leaves the error of a switch as it is.
    [[nodiscard]] bool is_of_drift() const { return constant_.keys.front().starts_with("drift."); }

    [[nodiscard]] Population population(double factor) const {
        return {task_.requirement, task_.requirement.base.run.seed, confirming_gyros,
                [this, factor](config::Config& c) {
                    constant_.of(c) *= factor;
                    if (constant_.rest != nullptr) constant_.rest(c, factor);
                }};
    }

    // The interval with the best chance; the candidate's own where no closed form knows what another leaves.
    [[nodiscard]] std::pair<double, Candidate> best(const Population& changed) const {
        Forecast forecast{changed, task_.threads, task_.is_stopped};
        if (is_of_drift()) forecast.take_laws(as_it_is_, candidate_.method);
        if (forecast.leaves_unknown(candidate_)) return {forecast.chance(candidate_), candidate_};
        std::pair<double, Candidate> found{-1.0, candidate_};
        for (const Candidate& c : candidates(task_.requirement, candidate_.method)) {
            const double chance = forecast.chance(c);
            if (chance > found.first) found = {chance, c};
        }
        return found;
    }

    [[nodiscard]] bool is_likely(double factor) const {
        return best(population(factor)).first >= task_.requirement.confidence;
    }

    [[nodiscard]] Evaluation tried(double factor) const {
        const Population changed = population(factor);
        Evaluation e{best(changed).second, {}};
        Tester{task_, changed}.extend(e, confirming_gyros, std::numeric_limits<double>::infinity(), {});
        return e;
    }

    const Task& task_;
    const Candidate& candidate_;
    const Constant& constant_;
    Forecast& as_it_is_;
};

Need need_of(const Task& task, const Candidate& candidate, const Constant& constant, Forecast& as_it_is) {
    config::Config gyro = with(task.requirement.base, candidate);
    Need need{.keys = constant.keys, .from = constant.of(gyro), .to = constant.of(gyro)};
    std::optional<Enough> nearest;
    for (const double direction : {-1.0, 1.0}) {
        if (need.from == 0.0) break;
        std::optional<Enough> found = Changed{task, candidate, constant, as_it_is}.enough(direction);
        if (found && (!nearest || std::abs(std::log(found->factor)) < std::abs(std::log(nearest->factor))))
            nearest = std::move(found);
    }
    if (nearest) {
        const double limit = task.requirement.limit_arcsec();
        need.is_enough = true;
        need.to *= nearest->factor;
        need.tried = confirming_gyros;
        need.share = nearest->trials.share(limit);
        need.sentence = fmt::format("{} from {} to {} ({}): {} of {} gyros then meet it.", constant.name,
                                    report::short_number(need.from), report::short_number(need.to),
                                    fmt::join(need.keys, " and "), nearest->trials.met(limit), need.tried);
        need.sentence.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(need.sentence.front())));
    } else {
        need.sentence = fmt::format("With this method no change of {} alone is enough, down or up to {:.0f} times.",
                                    constant.name, furthest);
    }
    return need;
}

}  // namespace

std::vector<Need> needs(const Task& task, const Candidate& candidate) {
    const Population same{task.requirement, task.requirement.base.run.seed, confirming_gyros};
    Forecast as_it_is{same, task.threads, task.is_stopped};
    std::vector<Need> all;
    for (const Constant& constant : constants()) all.push_back(need_of(task, candidate, constant, as_it_is));
    return all;
}

}  // namespace zlg::choice
