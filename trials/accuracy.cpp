#include <zlg/trials/accuracy.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include <zlg/numeric/parallel.hpp>

#include "accuracy_bound.hpp"
#include "accuracy_parts.hpp"
#include "accuracy_statistics.hpp"

namespace zlg::trials {
namespace {

// One course of one case.
struct Job {
    std::size_t of_case = 0;
    TrialCourse course;
};

std::vector<Job> jobs_of(const std::vector<AccuracyCase>& cases, std::uint64_t seed) {
    std::vector<Job> jobs;
    for (std::size_t c = 0; c < cases.size(); ++c) {
        for (int done = 0, k = 0; done < cases[c].switches; done += switches_per_course, ++k) {
            jobs.push_back(
                {c,
                 {.gyro = cases[c].gyro,
                  .motion = cases[c].motion,
                  .switches = std::min(switches_per_course, cases[c].switches - done),
                  .seed = (seed << 40) + (static_cast<std::uint64_t>(c) << 20) + static_cast<std::uint64_t>(k)}});
        }
    }
    return jobs;
}

BoundFigures bound_figures(const AccuracyCase& c) {
    if (!c.has_bound) return {};
    const SwitchBound b = bound_of(c.gyro, c.motion);
    return {.ticks = b.ticks_arcsec,
            .halves = b.halves_arcsec,
            .known_rate = b.known_rate_arcsec,
            .relock = b.relock_arcsec};
}

// What compensation presumes is right but for what the law of the case calls wrong.
using CourseErrors = std::vector<std::vector<SwitchError>>;

CaseFigures gather(const AccuracyCase& c, const std::vector<const CourseErrors*>& courses) {
    CaseFigures figures{.group = c.group, .name = c.name, .bound = bound_figures(c), .methods = {}};
    for (std::size_t m = 0; m < c.methods.size(); ++m) {
        std::vector<SwitchError> all;
        for (const CourseErrors* errors : courses) all.insert(all.end(), (*errors)[m].begin(), (*errors)[m].end());
        figures.methods.push_back({.method = c.methods[m],
                                   .of_paper = is_of_paper(c.methods[m]),
                                   .whole = figures_of(all),
                                   .relock = relock_figures_of(all)});
    }
    return figures;
}

std::vector<CaseFigures> measure_cases(const AccuracyTask& task) {
    std::vector<AccuracyCase> cases = accuracy_cases(task.quick);
    for (AccuracyCase& c : cases) c.switches = std::max(1, static_cast<int>(std::lround(task.share * c.switches)));
    const std::vector<Job> jobs = jobs_of(cases, task.seed);
    std::vector<CourseErrors> errors(jobs.size());
    std::atomic<std::size_t> done = 0;
    std::mutex telling;
    numeric::in_parallel(jobs.size(), task.threads, [&](std::size_t k) {
        const AccuracyCase& c = cases[jobs[k].of_case];
        errors[k] = run_course(jobs[k].course, methods_for(c.gyro, c.methods));
        const double share = static_cast<double>(++done) / static_cast<double>(jobs.size());
        const std::scoped_lock lock{telling};
        if (task.on_progress) task.on_progress(share);
    });
    std::vector<CaseFigures> figures(cases.size());
    numeric::in_parallel(cases.size(), task.threads, [&](std::size_t c) {
        std::vector<const CourseErrors*> of_case;
        for (std::size_t k = 0; k < jobs.size(); ++k)
            if (jobs[k].of_case == c) of_case.push_back(&errors[k]);
        figures[c] = gather(cases[c], of_case);
    });
    return figures;
}

}  // namespace

Accuracy measure_accuracy(const AccuracyTask& task) {
    Accuracy accuracy{
        .task = task, .cases = {}, .recordings = {}, .relock = {}, .drift = {}, .long_runs = {}, .criteria = {}};
    for (const Recording& r : task.recordings) accuracy.recordings.push_back(measure_recording(r));
    for (RecordingFigures& r : measure_journeys(task)) accuracy.recordings.push_back(std::move(r));
    accuracy.cases = measure_cases(task);
    accuracy.relock = measure_relock(task);
    accuracy.drift = measure_drift(task);
    if (task.long_runs) accuracy.long_runs = measure_long_runs(task);
    accuracy.criteria = judge(accuracy);
    return accuracy;
}

}  // namespace zlg::trials
