#pragma once
// What a sweep is: how many gyros, what they have in common, what is drawn for each, what is recorded of each.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <zlg/config/schema.hpp>

namespace zlg::sweep {

enum class DrawKind { grid, list, uniform, log_uniform, normal, truncated, latin, sobol };

// A number, or the TOML of what is none.
using Value = std::variant<double, std::string>;

// As it is written into a configuration.
[[nodiscard]] std::string toml_of(const Value& value);

// One draw a gyro, and the keys that all take its value.
struct Parameter {
    std::vector<std::string> keys;  // dotted, as `piezo.half_wave_v`
    DrawKind draw{};
    std::vector<Value> values;  // of grid and list, one at least
    double min = 0.0;           // of uniform, log_uniform, truncated, latin, sobol
    double max = 0.0;
    double mean = 0.0;  // of normal, truncated
    double sd = 0.0;

    friend bool operator==(const Parameter&, const Parameter&) = default;
};

// A number of the summary that is recorded, and the limits within which a gyro passes.
struct Metric {
    std::string name;  // as `configured.switch_error_rms_arcsec`
    std::optional<double> min;
    std::optional<double> max;

    friend bool operator==(const Metric&, const Metric&) = default;
};

struct Description {
    std::int64_t n_gyros = 0;
    std::uint64_t seed = 1;
    std::optional<double> duration_s;                       // unset: as of a run
    bool sobol_shift = true;                                // whether Sobol's points get a random digital shift
    std::vector<std::pair<std::string, std::string>> base;  // dotted keys with their TOML
    std::map<std::string, std::string> motion_checksums;    // by path; see motion_files.hpp
    std::vector<Parameter> parameters;
    std::vector<Metric> metrics;

    friend bool operator==(const Description&, const Description&) = default;
};

inline constexpr std::int64_t max_gyros = 10'000'000;

// source_name  begins the messages, as in `sweep.toml:3: ...`.
//
// errors  config::ConfigError: no TOML, an unknown key, a value or a range that a key does not take, parameters that
//         contradict each other, no metric or an unknown one, no gyro or more than max_gyros.
[[nodiscard]] Description parse(std::string_view text, std::string_view source_name);
[[nodiscard]] Description read_description(const std::string& path);

// Every value written out, in a fixed order: parse(to_toml(d), ...) == d. The first line names the program's version.
[[nodiscard]] std::string to_toml(const Description& description);

// The base of all gyros.
//
// errors  config::ConfigError, as config::apply_pair.
[[nodiscard]] config::Config base_config(const Description& description, std::string_view source_name = "[base]");

// Whether gyros can be added to a sweep: not where the draws of all depend on how many they are, grid and latin.
[[nodiscard]] bool may_grow(const Description& description);

// How many points the grid has: the product over the parameters that are drawn so; 1 without any.
[[nodiscard]] std::int64_t grid_points(const Description& description);

// Whether results of two sweeps, as their to_toml, go together: their gyros are the same as far as both have them. The
// limits of the metrics may differ, and the number of gyros where it may grow.
//
// return  empty where they do; else what differs, `has `seed = 1`, this one `seed = 2``.
[[nodiscard]] std::string difference(const std::string& theirs, const std::string& ours);

// The same where every line must agree.
[[nodiscard]] std::string first_difference(const std::string& theirs, const std::string& ours);

// The names of the draws in a description, in the order of DrawKind.
inline constexpr std::array<std::string_view, 8> draw_names{"grid",   "list",      "uniform", "log_uniform",
                                                            "normal", "truncated", "latin",   "sobol"};

[[nodiscard]] constexpr std::string_view name_of(DrawKind kind) { return draw_names[static_cast<std::size_t>(kind)]; }

// Which numbers a draw is described by.
[[nodiscard]] constexpr bool has_values(DrawKind kind) { return kind == DrawKind::grid || kind == DrawKind::list; }
[[nodiscard]] constexpr bool has_mean(DrawKind kind) { return kind == DrawKind::normal || kind == DrawKind::truncated; }
[[nodiscard]] constexpr bool has_range(DrawKind kind) { return !has_values(kind) && kind != DrawKind::normal; }

}  // namespace zlg::sweep
