#pragma once
// The plan of an acceptance test: which unit, which runs with which logs, and the limits of each quantity.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <zlg/logs/mapping.hpp>

namespace zlg::acceptance {

enum class RunKind { at_rest, rate_table, warm_up, magnetic, temperature, switching };

// "static", "rate_table", ... errors  config::ConfigError: another name.
[[nodiscard]] RunKind kind_of(std::string_view name, const std::string& where);
[[nodiscard]] std::string_view name_of(RunKind kind);

// A stretch of a run in which the table turned at one rate.
struct Stage {
    double from_s = 0.0;
    double to_s = 0.0;
    double rate_arcsec_s = 0.0;
};

struct Run {
    RunKind kind = RunKind::at_rest;
    std::vector<std::string> files;
    std::vector<Stage> stages;
    std::string axis;       // "up", "north", ...: where the axis of the gyro points; else a label
    double field_mt = 0.0;  // of a magnetic run, along the axis
    std::string serial;     // of the unit, where the run says it
    logs::Mapping mapping;  // of files of other programs
    std::string place;      // "plan.toml:7: [[run]] 2", which begins a message
    int number = 1;         // in the plan
};

struct Limit {
    std::string name;  // "bias.deg_h"
    std::optional<double> min, max;
};

struct Unit {
    std::string serial, type, operator_name, equipment, date;
    std::optional<double> scale_arcsec;  // nominal, of a count
    std::optional<double> latitude_deg;
};

struct Plan {
    std::string path;
    Unit unit;
    std::vector<Run> runs;
    std::vector<Limit> limits;
    double risk = 0.05;
    double warm_up_band_deg_h = 0.0;  // within which the bias has settled; 0: not said
};

// errors  config::ConfigError: no TOML, an unknown section, key, kind of run or quantity, a value that it does not
// take, a run without files, a limit of a quantity for which the plan has no run; logs::MappingError; logs::IoError: it
// cannot be read, or is longer than a plan can be.
[[nodiscard]] Plan read_plan(const std::string& path);

// The rotation of the Earth about an axis that points "up", "down", "north", "south", "east" or "west", arcsec/s;
// absent for another word, or where no latitude is known.
[[nodiscard]] std::optional<double> earth_about(const Unit& unit, std::string_view axis);

// A commented plan for these logs, each a static run: what they say of themselves is filled in.
//
// errors  those of looking at the logs.
[[nodiscard]] std::string plan_for(const std::vector<std::string>& logs);

}  // namespace zlg::acceptance
