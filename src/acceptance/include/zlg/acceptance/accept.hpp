#pragma once
// The acceptance test of one gyro: its plan carried out on its logs.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <zlg/acceptance/plan.hpp>
#include <zlg/acceptance/verdict.hpp>
#include <zlg/config/config.hpp>
#include <zlg/report/figure.hpp>

namespace zlg::acceptance {

struct TestedLog {
    std::string file;            // as the plan names it
    std::uint64_t checksum = 0;  // XXH64 of its bytes
};

struct TestedRun {
    int number = 1;
    RunKind kind = RunKind::at_rest;
    double hours = 0.0;
    std::vector<TestedLog> logs;
    std::vector<std::string> notes;
    std::vector<std::string> stops;  // why no verdict rests on it
};

struct Acceptance {
    Plan plan;
    std::uint64_t plan_checksum = 0;
    std::string settings;  // lines of TOML: what the user said over the defaults
    std::vector<TestedRun> runs;
    std::vector<Judged> quantities;   // in the order of `quantities()`
    std::optional<double> unit_risk;  // that a unit which passes lies beyond one of the limits; none: it does not pass
    std::vector<report::Figure> figures;  // what the verdicts rest on

    // Every limit passes, and there is one.
    [[nodiscard]] bool passed() const;
};

struct AcceptTask {
    std::string plan;
    config::Config said;  // keys that it was given go over what the logs say
    int threads = 1;
    std::function<void(double)> on_progress{};  // of the fraction of all runs; may be empty
};

// errors  as read_plan; logs::IoError, logs::FormatError, logs::MappingError, config::ConfigError: a log that is not
// what the plan says, one of another serial number, one that stands twice, one that ends before the stages of its
// table.
[[nodiscard]] Acceptance accept(const AcceptTask& task);

}  // namespace zlg::acceptance
