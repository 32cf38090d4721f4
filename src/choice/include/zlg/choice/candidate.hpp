#pragma once
// What may be chosen, in the order of simplicity.
//
// A method is simpler than another where it adds less to the paper's gyro and its rules: its reading by four counts a
// fringe, a schedule that measures, the joint estimate, the estimate of the magnetic drift and another tick than the
// gyro's add 1 each, reading by phase 2. Of equal ones that is the simpler whose addition comes first in this list:
// corrections and bridges (the paper's in their order, then the joint estimate), reading, schedule, magnetic drift,
// tick. The loop is the gyro's. Within a method a longer interval is simpler than a shorter one, and of one interval a
// full first segment than a half one.

#include <string>
#include <utility>
#include <vector>

#include <zlg/choice/requirement.hpp>

namespace zlg::choice {

enum class Reading { x1, x4, phase };

struct Method {
    core::RelockMethod relock = core::RelockMethod::mean_square;
    core::BridgeMethod bridge = core::BridgeMethod::quadratic;
    Reading reading = Reading::x1;
    config::Schedule schedule = config::Schedule::fixed;
    core::MagneticMethod magnetic = core::MagneticMethod::none;
    double tick_s = 0.005;
    int additions = 0;  // to the paper's gyro

    friend bool operator==(const Method&, const Method&) = default;
};

struct Candidate {
    Method method;
    double interval_s = 90.0;
    config::FirstSegment first_segment = config::FirstSegment::full;
};

// Those that the requirement leaves open and that its delay allows, simplest first. What it excludes by the tick is
// said in `excluded`, a sentence each.
struct Methods {
    std::vector<Method> all;
    std::vector<std::string> excluded;
};
[[nodiscard]] Methods methods(const Requirement& requirement);

// The intervals of a method, simplest first: the run, which has no switch, whole parts of it, and preferred numbers.
[[nodiscard]] std::vector<Candidate> candidates(const Requirement& requirement, const Method& method);

// What goes with a factor on the tick: a gap lasts as long as before, and the walk is that of lock-in, 1/sqrt(T).
void keep_with_tick(config::Config& gyro, double factor);

// The gyro with what is chosen for it.
[[nodiscard]] config::Config with(config::Config gyro, const Candidate& candidate);

// The keys that `with` decides, dotted, with their TOML.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> chosen_keys(const config::Config& gyro,
                                                                           const Candidate& candidate);

// In words, as "x1, mean_square and quadratic, fixed".
[[nodiscard]] std::string in_words(const Candidate& candidate);

// From a tick to its final value; infinite where it is later than any compensation holds.
[[nodiscard]] double final_delay_s(const config::Config& gyro);

}  // namespace zlg::choice
