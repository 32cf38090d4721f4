#pragma once
// The parts that the whole of an accuracy campaign is put together from.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/trials/accuracy.hpp>

#include "accuracy_law.hpp"
#include "accuracy_trial.hpp"

namespace zlg::trials {

// Names by which a method is found again in the figures.
namespace method_name {
inline constexpr const char* optimal = "joint, optimal";
inline constexpr const char* automatic = "joint, auto";
inline constexpr const char* automatic_ticks = "mean square, auto";
inline constexpr const char* flat = "joint, optimal, flat prior";
inline constexpr const char* constant = "mean square, constant";
inline constexpr const char* linear = "mean square, linear";
inline constexpr const char* quadratic = "mean square, quadratic";
inline constexpr const char* detuning_constant = "(13), constant";
inline constexpr const char* detuning_quadratic = "(13), quadratic";
inline constexpr const char* frequency_quadratic = "(11), quadratic";
inline constexpr const char* uncorrected = "none, quadratic";
}  // namespace method_name

[[nodiscard]] bool is_of_paper(const std::string& method);

// The configuration of such a gyro.
[[nodiscard]] config::Config config_of(const GyroLaw& gyro);

// For a gyro that is as it is presumed to be.
[[nodiscard]] std::vector<AccuracyMethod> methods_for(const GyroLaw& gyro, const std::vector<std::string>& names);

struct AccuracyCase {
    char group = 'a';
    std::string name;
    GyroLaw gyro;
    MotionLaw motion;
    int switches = 400;
    bool has_bound = true;
    std::vector<std::string> methods;
};

[[nodiscard]] std::vector<AccuracyCase> accuracy_cases(bool quick);

// Courses of one case, each of this many switches; the last may be shorter.
inline constexpr int switches_per_course = 20;

[[nodiscard]] std::vector<RecordingFigures> measure_journeys(const AccuracyTask& task);

[[nodiscard]] std::vector<RelockFigures> measure_relock(const AccuracyTask& task);

[[nodiscard]] std::vector<SwitchingDrift> measure_drift(const AccuracyTask& task);

// The twin in closed loop, with the schedule that measures and at the paper's fixed intervals.
[[nodiscard]] std::vector<DriftFigures> measure_long_runs(const AccuracyTask& task);

[[nodiscard]] std::vector<Criterion> judge(const Accuracy& accuracy);

[[nodiscard]] const MethodFigures* find_method(const std::vector<MethodFigures>& methods, const std::string& name);

}  // namespace zlg::trials
