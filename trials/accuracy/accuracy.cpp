#include <zlg/trials/accuracy.hpp>

#include <algorithm>
#include <cmath>

#include <zlg/chance/draw.hpp>
#include <zlg/numeric/parallel.hpp>

#include "bound.hpp"
#include "parts.hpp"

namespace zlg::trials {
namespace {

struct Job {
    std::size_t of_case = 0;
    SwitchTrial trial;
};

SwitchTrial trial_of(const AccuracyCase& c, int done, std::uint64_t seed) {
    SwitchTrial trial{.gyro = c.gyro,
                      .motion = c.motion,
                      .switches = std::min(c.switches_of_trial, c.switches - done),
                      .learn_ticks = c.min_start,
                      .interval_ticks = c.interval_ticks,
                      .seed = seed};
    if (c.max_start > c.min_start)
        trial.learn_ticks = static_cast<std::int64_t>(chance::Draw{seed, chance::Cause::switch_start}.within(
            static_cast<double>(c.min_start), static_cast<double>(c.max_start)));
    return trial;
}

std::vector<Job> jobs_of(const std::vector<AccuracyCase>& cases, std::uint64_t seed) {
    std::vector<Job> jobs;
    for (std::size_t c = 0; c < cases.size(); ++c) {
        for (int done = 0, k = 0; done < cases[c].switches; done += cases[c].switches_of_trial, ++k)
            jobs.push_back(
                {c, trial_of(cases[c], done,
                             (seed << 40) + (static_cast<std::uint64_t>(c) << 20) + static_cast<std::uint64_t>(k))});
    }
    return jobs;
}

// By method, over all trials of the case.
CaseFigures figures_of_case(const AccuracyCase& c, const std::vector<std::vector<SwitchError>>& errors) {
    CaseFigures figures{.group = c.group, .name = c.name};
    if (c.has_bound) figures.bound = bound_of(c.gyro, c.motion);
    for (std::size_t m = 0; m < c.methods.size(); ++m)
        figures.methods.push_back(
            {.method = c.methods[m], .of_paper = is_of_paper(c.methods[m]), .whole = figures_of(errors[m])});
    return figures;
}

std::vector<CaseFigures> measure_cases(const AccuracyTask& task) {
    std::vector<AccuracyCase> cases = accuracy_cases(task.quick);
    for (const auto& more : {gap_cases(task.quick), phase_cases(task.quick)})
        cases.insert(cases.end(), more.begin(), more.end());
    for (AccuracyCase& c : cases) c.switches = std::max(1, static_cast<int>(std::lround(task.share * c.switches)));
    const std::vector<Job> jobs = jobs_of(cases, task.seed);
    std::vector<std::vector<std::vector<SwitchError>>> errors(jobs.size());
    numeric::in_parallel(jobs.size(), task.threads, [&](std::size_t k) {
        const AccuracyCase& c = cases[jobs[k].of_case];
        errors[k] = run_trial(jobs[k].trial, methods_for(config_of(c.gyro), c.methods));
    });
    std::vector<CaseFigures> figures(cases.size());
    numeric::in_parallel(cases.size(), task.threads, [&](std::size_t c) {
        std::vector<std::vector<SwitchError>> of_case(cases[c].methods.size());
        for (std::size_t k = 0; k < jobs.size(); ++k)
            for (std::size_t m = 0; jobs[k].of_case == c && m < of_case.size(); ++m)
                of_case[m].insert(of_case[m].end(), errors[k][m].begin(), errors[k][m].end());
        figures[c] = figures_of_case(cases[c], of_case);
    });
    return figures;
}

}  // namespace

Accuracy measure_accuracy(const AccuracyTask& task) {
    Accuracy accuracy{.task = task};
    for (const Recording& r : task.recordings) accuracy.recordings.push_back(measure_recording(r));
    for (RecordingFigures& r : measure_vehicles(task)) accuracy.recordings.push_back(std::move(r));
    accuracy.cases = measure_cases(task);
    accuracy.relock = measure_relock(task);
    const int gaps = std::max(1, static_cast<int>(std::lround(task.share * (task.quick ? 100.0 : 500.0))));
    accuracy.manoeuvres = measure_manoeuvres(gaps, task.quick, task.seed, task.threads);
    accuracy.changes = measure_changes(gaps, task.quick, task.seed, task.threads);
    accuracy.gap_lengths = measure_gap_lengths(task);
    accuracy.criteria = criteria_of(accuracy);
    return accuracy;
}

}  // namespace zlg::trials
