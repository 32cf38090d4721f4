#pragma once
// The questions of a designer answered for one gyro: how long between switches, which substitution, which loop.

#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/design/drift_budget.hpp>
#include <zlg/design/interval_formula.hpp>
#include <zlg/design/switching_interval.hpp>
#include <zlg/report/page.hpp>
#include <zlg/study/design_lines.hpp>

namespace zlg::study {

// The best interval of one budget for one length of run.
struct IntervalLine {
    double run_s = 0.0;
    design::IntervalMethod method = design::IntervalMethod::corrected;
    design::Optimum optimum;
};

// What else there is to say of one length of run.
struct RunLine {
    double run_s = 0.0;
    design::Optimum best;                // with what a switch of this gyro leaves
    design::DriftTerms terms;            // of (7c) at its best interval
    design::Optimum half_first_segment;  // worst case
    design::Roots corrected_roots;       // (9c)
    design::Roots roots_as_printed;      // (9)
};

struct DesignResult {
    double switch_error_arcsec = 0.0;    // rms: as given, or what a trial of the gyro says
    bool switch_error_is_given = false;  // by design.switch_error_arcsec
    std::string switch_error_source;     // in words
    std::vector<IntervalLine> intervals;
    std::vector<RunLine> runs;
    std::vector<SubstitutionLine> substitution;
    LoopLine loop;
};

// The gyro's drift as the theory sees it; the run is that of the configuration.
[[nodiscard]] design::DriftCase drift_case(const config::Config& config, double run_s);

// The interval that `interval_s = "optimal"` stands for in a run of run_s, but for the shortest that a switch needs:
// the minimum of what is to be expected of independent switch errors and an end that nobody knows, with the first
// segment that is configured.
//
// The magnetic drift is in it as [drift] has it: what compensation.magnetic = "estimate" takes out of it is not
// foreseen.
//
// switch_error_arcsec  rms, as study::switch_error_arcsec has it.
[[nodiscard]] design::Optimum best_interval(const config::Config& config, double switch_error_arcsec, double run_s);

// The same configuration with that number in place of "optimal", for its own length of run.
//
// errors  as design_gyro; those of rig::motion and rig::run_ticks.
[[nodiscard]] config::Config with_interval(config::Config config, double switch_error_arcsec);

// errors  design::DesignError for a gyro without a budget, such as one whose switches cost nothing.
[[nodiscard]] DesignResult design_gyro(const config::Config& config);

[[nodiscard]] report::Page design_page(const config::Config& config, const DesignResult& result);

}  // namespace zlg::study
