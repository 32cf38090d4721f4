// What the table of keys allows, the gyro takes: ranges of the configuration, checks of the core and the twin's own are
// one.
//
// One key after the other gets both ends of what `zlg --keys` allows and values from between, in a gyro of each kind.
// The gyro runs, or is refused by a line that names a key which was set, its value and what is allowed. ZLG_DRAWS:
// values a key and gyro.

#include <regex>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace zlg::allowed_values_test {

using Settings = config::Settings;

// The numbers that are allowed, as a reader of the words understands them.
struct Allowed {
    double min = -std::numeric_limits<double>::max();
    double max = std::numeric_limits<double>::max();
    bool zero = false;  // 0 too, besides them
};

Allowed in_words(const std::string& words) {
    const std::string number = R"(([-+]?[0-9.]+(?:e[-+]?[0-9]+)?))";
    Allowed a;
    std::smatch found;
    if (std::regex_search(words, found, std::regex{number + R"(\.\.)" + number})) {
        a.min = std::stod(found[1]);
        a.max = std::stod(found[2]);
    }
    if (std::regex_search(words, found, std::regex{"above " + number}))
        a.min = std::nextafter(std::stod(found[1]), std::numeric_limits<double>::max());
    if (std::regex_search(words, found, std::regex{"from " + number})) a.min = std::stod(found[1]);
    if (std::regex_search(words, found, std::regex{"up to " + number})) a.max = std::stod(found[1]);
    if (std::regex_search(words, found, std::regex{"to below " + number}))
        a.max = std::nextafter(std::stod(found[1]), -std::numeric_limits<double>::max());
    a.zero = words.starts_with("0 or ");
    return a;
}

// The k-th value: the least, the largest, and then any.
double draw(const Allowed& a, int k, std::mt19937_64& random) {
    const auto uniform = [&](double from, double to) {
        return std::uniform_real_distribution<double>{from, to}(random);
    };
    switch (k < 2 ? k : std::uniform_int_distribution<int>{0, 6}(random)) {
        case 0: return a.min;
        case 1: return a.max;
        case 2: return a.zero || (a.min <= 0.0 && a.max >= 0.0) ? 0.0 : a.min;
        default: break;
    }
    // Any order of magnitude is as likely as another, those of a gyro more than others.
    for (;;) {
        const double decades = uniform(0.0, 1.0) < 0.3 ? 300.0 : 9.0;
        const double least = a.min > 0.0 ? std::max(std::log10(a.min), -decades) : -decades;
        const double most = std::min(std::log10(std::max(std::abs(a.min), std::abs(a.max))), decades);
        const double x = std::pow(10.0, uniform(least, std::max(least, most)));
        for (const double y : {uniform(0.0, 1.0) < 0.5 ? -x : x, x})
            if (y >= a.min && y <= a.max) return y;
    }
}

std::string value_of(const config::KeyInfo& key, int k, std::mt19937_64& random) {
    using config::ValueKind;
    const auto pick = [&](const std::vector<std::string>& from) {
        return from[std::uniform_int_distribution<std::size_t>{0, from.size() - 1}(random)];
    };
    switch (key.kind) {
        case ValueKind::choice:
        case ValueKind::optional_choice:
        case ValueKind::choices: return fmt::format("\"{}\"", pick(key.choices));
        case ValueKind::text: return "\"text\"";
        case ValueKind::points: {
            const Allowed time{.min = -1e9, .max = 1e9}, value{.min = -1e6, .max = 1e6};
            std::vector<double> times;
            for (int n = 0; n < k % 4; ++n) times.push_back(draw(time, n, random));
            std::ranges::sort(times);
            std::string points;
            for (const double t : times)
                points += fmt::format("{}[{:.17e}, {:.17e}]", points.empty() ? "" : ", ", t, draw(value, k, random));
            return "[" + points + "]";
        }
        case ValueKind::column:
        case ValueKind::integer: {
            if (key.allowed == "-1 or 1") return pick({"-1", "1"});
            Allowed a = in_words(key.allowed);
            a.max = std::min(a.max, 9.2e18);
            return fmt::format("{:.0f}", std::clamp(std::round(draw(a, k, random)), a.min, a.max));
        }
        default: {
            const double x = draw(in_words(key.allowed), k, random);
            if (key.allowed.find("but 0") != std::string::npos && x == 0.0) return "1.0";
            return fmt::format("{:.17e}", x);
        }
    }
}

// A gyro, and what is needed for a switch within the few ticks that it runs.
struct Gyro {
    const char* name;
    Settings settings;
};

const std::vector<Gyro> gyros = {
    {"averaged", {}},
    {"digital loop",
     {{"perimeter.loop", "\"digital\""}, {"perimeter.relock_halves", "4"}, {"switching.gap_min_ticks", "1"}}},
    {"joint", {{"compensation.relock", "\"joint\""}, {"compensation.magnetic", "\"estimate\""}}},
    {"real piezo",
     {{"piezo.hysteresis", "0.1"},
      {"piezo.creep_per_decade", "0.01"},
      {"piezo.mirror_hz", "3000.0"},
      {"motion.kind", "\"sum\""}}},
    {"schedule", {{"switching.schedule", "\"measured\""}, {"run.duration_s", "100.0"}}},
    {"exponential", {{"perimeter.loop", "\"exponential\""}}},
    {"fault",
     {{"faults.kind", "\"vibration\""}, {"faults.at_s", "0.1"}, {"faults.duration_s", "0.1"}, {"faults.size", "0.01"}}},
    {"laser", {{"gyro.fidelity", "\"laser\""}, {"gyro.bias_hz", "38000.0"}, {"gyro.dither", "\"auto\""}}},
};

void run(const config::Config& config) {
    const twin::Motion motion = rig::motion(config);
    (void)rig::run_ticks(config, motion);
    for (const auto relock : {core::RelockMethod::none, core::RelockMethod::mean_square})
        (void)rig::compensation_config(config, relock, config.compensation.bridge);
    const auto made = rig::asked_compensation(config);
    core::GyroCompensationState state;
    rig::ClosedLoop loop{config, motion};
    for (int half = 0; half < 80; ++half) {
        const rig::LoopHalf done = loop.advance();
        (void)step(made, state, done.record, loop.light());
    }
}

// The refusal; empty where there is none.
std::string refusal(const Settings& settings) {
    config::Config config;
    for (const auto& [key, value] : settings) config::apply_pair(config, key, value, "test");
    try {
        config::check(config);
        if (config.switching.interval_optimal || config.motion.kind == config::MotionKind::file) return {};
        run(config);
        return {};
    } catch (const config::ConfigError& error) {
        return error.what();
    }
}

bool names(const std::string& message, const std::string& key) {
    const std::size_t at = message.find(key);
    return at != std::string::npos && (at + key.size() == message.size() || message[at + key.size()] != '_');
}

class AllowedValues : public testing::TestWithParam<std::size_t> {};

TEST_P(AllowedValues, AreTakenOrRefusedByTheirKey) {
    const Gyro& gyro = gyros[GetParam()];
    const char* asked = std::getenv("ZLG_DRAWS");
    const bool is_laser = std::string_view{gyro.name} == "laser";
    const int n_draws = asked != nullptr ? std::atoi(asked) : (is_laser ? 1 : 12);
    std::mt19937_64 random{GetParam() + 1};
    std::set<std::string> complaints;
    for (const config::KeyInfo& key : config::describe_keys()) {
        if (key.section == "analysis" || key.section == "design") continue;
        // The table of a laser takes its time: both ends of its own keys, one value of the others.
        for (int k = 0; k < (is_laser && key.section == "laser" ? std::max(n_draws, 2) : n_draws); ++k) {
            const std::string dotted = key.section + "." + key.name;
            const std::string value = value_of(key, k, random);
            Settings settings = gyro.settings;
            settings.emplace_back(dotted, value);
            try {
                const std::string message = refusal(settings);
                const bool is_named = std::ranges::any_of(
                    settings, [&message](const auto& setting) { return names(message, setting.first); });
                if (!message.empty() && !is_named)
                    complaints.insert(fmt::format("{} = {}: not named: {}", dotted, value, message));
            } catch (const std::exception& error) {
                complaints.insert(fmt::format("{} = {}: {}", dotted, value, error.what()));
            }
        }
    }
    std::string text;
    for (const std::string& complaint : complaints) text += complaint + "\n";
    EXPECT_TRUE(complaints.empty()) << gyro.name << ":\n" << text;
}

INSTANTIATE_TEST_SUITE_P(Gyros, AllowedValues, testing::Range<std::size_t>(0, gyros.size()), [](const auto& tested) {
    std::string name = gyros[tested.param].name;
    for (char& c : name)
        if (c == ' ') c = '_';
    return name;
});

}  // namespace zlg::allowed_values_test
