#pragma once
// The parts that the whole of an accuracy campaign is put together from.

#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/trials/accuracy.hpp>

#include "synthetic/laws.hpp"
#include "trial.hpp"

namespace zlg::trials {

// Names by which a method is found again in the figures.
namespace method_name {
inline constexpr const char* automatic = "joint, auto";
inline constexpr const char* automatic_ticks = "mean square, auto";
inline constexpr const char* constant = "mean square, constant";
inline constexpr const char* linear = "mean square, linear";
inline constexpr const char* quadratic = "mean square, quadratic";
inline constexpr const char* detuning_constant = "(13), constant";
inline constexpr const char* detuning_quadratic = "(13), quadratic";
inline constexpr const char* frequency_quadratic = "(11), quadratic";
inline constexpr const char* uncorrected = "none, quadratic";
inline constexpr const char* uncorrected_automatic = "none, auto";
}  // namespace method_name

// Cases that are found again by their names, without the readout.
namespace main_case {
inline constexpr const char* rest = "rest";
inline constexpr const char* tone = "20.06 Hz, 12 000 \"/s";
inline constexpr const char* tone_with_walk = "20.06 Hz, 12 000 \"/s, random walk of 0.14 \"/sqrt(s)";
inline constexpr const char* two_tones = "7.03 and 23.71 Hz";
inline constexpr const char* band = "flat to 20 Hz, 8485 \"/s";
inline constexpr const char* learnt_band = "flat to 20 Hz, 8485 \"/s, from 200 s on";
inline constexpr const char* vibration = "5 to 80 Hz, 8000 \"/s";
}  // namespace main_case
inline constexpr const char* lit_halves_name = ", three halves lit";

[[nodiscard]] bool is_of_paper(const std::string& method);

// The configuration of such a gyro, as the compensation presumes it.
[[nodiscard]] config::Config config_of(const GyroLaw& gyro);

[[nodiscard]] std::vector<AccuracyMethod> methods_for(const config::Config& gyro,
                                                      const std::vector<std::string>& names);

struct AccuracyCase {
    CaseGroup group = CaseGroup::paper;
    std::string name;
    GyroLaw gyro;
    MotionLaw motion;
    int switches = 400;
    int switches_of_trial = 20;  // few enough that the trials of a case keep all threads busy
    std::int64_t interval_ticks = 4000;
    std::int64_t min_start = 5000, max_start = 5000;  // ticks before the first switch of a trial
    bool has_bound = true;
    std::vector<std::string> methods;
};

// A sine of 12 000 arcsec/s at each of some frequencies, read in one way.
void add_sweep(std::vector<AccuracyCase>& cases, CaseGroup group, const char* readout);

[[nodiscard]] std::vector<AccuracyCase> accuracy_cases(bool quick);

// Cases of gap lengths, of the first gap, of the phase of the fringe and of halves of a gap that are lit.
[[nodiscard]] std::vector<AccuracyCase> gap_cases(bool quick);
[[nodiscard]] std::vector<AccuracyCase> phase_cases(bool quick);

// The same gyro, its fringes counted once, four times, or with the phase.
inline constexpr const char* readouts[] = {"x1", "x4", "phase"};
[[nodiscard]] GyroLaw gyro_of(const std::string& readout);

[[nodiscard]] AccuracyCase make_case(CaseGroup group, const std::string& name, const std::string& readout,
                                     const MotionLaw& motion, int switches);

[[nodiscard]] std::vector<RecordingFigures> measure_vehicles(const AccuracyTask& task);

[[nodiscard]] std::vector<RelockFigures> measure_relock(const AccuracyTask& task);

// The recordings again, with gaps of 1 to 10 ticks.
[[nodiscard]] std::vector<GapLengthFigures> measure_gap_lengths(const AccuracyTask& task);

[[nodiscard]] std::vector<Criterion> criteria_of(const Accuracy& accuracy);

// The part of them that concerns first manoeuvres.
void add_manoeuvre_criteria(const Accuracy& accuracy, std::vector<Criterion>& out);

// The part of them that concerns gap lengths, first gaps, changes of the motion, the phase and lit halves.
void add_gap_criteria(const Accuracy& accuracy, std::vector<Criterion>& out);

// Many errors and the sigmas that were claimed for them, in a few figures.
[[nodiscard]] ErrorFigures figures_of(const std::vector<SwitchError>& errors);

[[nodiscard]] const MethodFigures* find_method(const std::vector<MethodFigures>& methods, const std::string& name);

}  // namespace zlg::trials
