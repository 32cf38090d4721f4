#pragma once
// Parts of the page of a run: its figures and its sentences.

#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/study/run.hpp>

namespace zlg::study {

// Of the whole run.
[[nodiscard]] report::Figure sawtooth_figure(const config::Config& config, const RunResult& result);
[[nodiscard]] report::Figure sum_figure(const RunResult& result);

// Of one switch.
[[nodiscard]] report::Figure magnified_figure(const RunResult& result);
[[nodiscard]] report::Figure detuning_figure(const RunResult& result);

// Of all switches.
[[nodiscard]] report::Figure switch_error_figure(const RunResult& result);

[[nodiscard]] double duration_s(const RunResult& result);

// The result in one sentence.
[[nodiscard]] std::string run_verdict(const config::Config& config, const RunResult& result);

// "laser_off at 20 s for 5 s" and so on, four of them and how many more; empty where the configuration has no fault.
[[nodiscard]] std::vector<std::string> faults_of(const config::Config& config);

}  // namespace zlg::study
