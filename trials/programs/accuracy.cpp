// Campaigns of errors and of the sigmas that are claimed for them: of a switch, of the terms of the noise.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <type_traits>

#include <fmt/format.h>

#include <unistd.h>

#include <zlg/trials/accept_campaign.hpp>
#include <zlg/trials/accuracy.hpp>
#include <zlg/trials/noise_campaign.hpp>
#include <zlg/trials/sigma_campaign.hpp>

#include "campaigns.hpp"

namespace zlg::trials {
namespace {

// Options of a motion are of the file named last.
void add_motion_options(CLI::App& app, std::vector<Recording>& recordings) {
    const auto last = [&recordings](const char* name) -> Recording& {
        if (recordings.empty()) throw CLI::RequiresError(name, "--motion");
        return recordings.back();
    };
    const auto of_last = [&app, last](const char* name, auto Recording::*member, const char* what) {
        using Value = std::remove_reference_t<decltype(std::declval<Recording&>().*member)>;
        return app
            .add_option_function<Value>(
                name, [=](const Value& value) { last(name).*member = value; }, what)
            ->trigger_on_parse();
    };
    app.add_option_function<std::string>(
           "--motion",
           [&recordings](const std::string& path) {
               recordings.push_back({.name = std::filesystem::path{path}.filename().string(), .path = path});
           },
           "a recording; the options below are of the one named last")
        ->trigger_on_parse();
    of_last("--columns", &Recording::columns, "the first is 1")->delimiter(',');
    of_last("--rate-hz", &Recording::rate_hz, "rows a second");
    of_last("--scale", &Recording::scale_arcsec, "arcsec of a unit of the column");
    of_last("--count", &Recording::count_arcsec, "arcsec of a count of the counter that reads it");
    of_last("--comment", &Recording::comment, "first character of a line to leave out");
    of_last("--skip-lines", &Recording::skip_lines, "lines to leave out first");
    app.add_flag_callback("--holds-rate", [last] { last("--holds-rate").holds_rate = true; })->trigger_on_parse();
}

struct ManoeuvreTask {
    int gaps = 500;
    bool quick = false, members = false;
    std::uint64_t seed = 1;
    int threads = 2;
};

void print_manoeuvres(const ManoeuvreTask& task) {
    fmt::print("| base | manoeuvre | auto, \" | best polynomial, \" | auto/best | NEV | within 3 sigma, % |\n");
    for (const ManoeuvreFigures& f : measure_manoeuvres(task.gaps, task.quick, task.seed, task.threads)) {
        const ErrorFigures& a = f.methods[0].whole;
        const double ratio = over_best_polynomial(f);
        fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} |\n", f.base, f.manoeuvre, a.rms_arcsec,
                   a.rms_arcsec / ratio, ratio, a.nev, 100.0 * a.within_3_sigma_ratio);
    }
}

// What is left of the error when a member of the bank is taken out: rms without it over rms with all.
void print_members(const ManoeuvreTask& task) {
    const std::vector<ManoeuvreFigures> all = measure_members(task.gaps, task.seed, task.threads);
    fmt::print("| gaps | without member | least ratio | median | largest |\n");
    for (const bool first : {false, true}) {
        for (std::size_t m = 1; m < all.front().methods.size(); ++m) {
            std::vector<std::pair<double, std::string>> ratio;
            for (const ManoeuvreFigures& f : all)
                if ((f.manoeuvre == "first gap") == first)
                    ratio.emplace_back(f.methods[m].whole.rms_arcsec / f.methods[0].whole.rms_arcsec,
                                       fmt::format("{}, {}", f.base, f.manoeuvre.empty() ? "nothing" : f.manoeuvre));
            std::sort(ratio.begin(), ratio.end());
            fmt::print("| {} | {} | {:.2f} ({}) | {:.2f} | {:.2f} ({}) |\n", first ? "first gaps" : "known motion", m,
                       ratio.front().first, ratio.front().second, ratio[ratio.size() / 2].first, ratio.back().first,
                       ratio.back().second);
        }
    }
}

}  // namespace

Work accuracy(CLI::App& app) {
    const auto task = std::make_shared<AccuracyTask>();
    app.add_flag("--quick", task->quick, "a tenth of the trials, without the grid (b)");
    app.add_option("--share", task->share, "of the trials of each case")->check(CLI::PositiveNumber);
    add_seed_and_threads(app, *task);
    add_motion_options(app, task->recordings);
    return [task] {
        const Accuracy accuracy = measure_accuracy(*task);
        fmt::print("{}", markdown(accuracy));
        return std::ranges::count(accuracy.criteria, Verdict::missed, &Criterion::verdict) == 0 ? 0 : 1;
    };
}

Work manoeuvres(CLI::App& app) {
    const auto task = std::make_shared<ManoeuvreTask>();
    app.add_option("GAPS", task->gaps, "of each family")->check(CLI::PositiveNumber);
    app.add_flag("--quick", task->quick, "the main families only");
    app.add_flag("--members", task->members, "what each member of the bank of the estimate buys");
    add_seed_and_threads(app, *task);
    return [task] {
        (task->members ? print_members : print_manoeuvres)(*task);
        return 0;
    };
}

// Exit 1 where, for a class of motion, the mean square of error over sigma is outside .25 to 1.4 by more than chance,
// or a switch has no sigma.
Work sigma(CLI::App& app) {
    const auto task = std::make_shared<SigmaTask>();
    app.add_option("SHARE", task->share, "times the usual number of gyros")->check(CLI::Range(1e-6, 1000.0));
    add_seed_and_threads(app, *task);
    return [task] {
        const auto figures = run_sigma_campaign(*task);
        fmt::print("{}", campaign_text(figures));
        return std::ranges::all_of(figures, is_true) ? 0 : 1;
    };
}

Work noise_terms(CLI::App& app) {
    const auto task = std::make_shared<NoiseCampaignTask>();
    app.add_option("GYROS", task->n_gyros)->check(CLI::PositiveNumber);
    app.add_option("SAMPLES", task->n_samples)->check(CLI::Range(4096.0, 1e9));
    app.add_flag("--filters", task->filters, "gyros with low passes, of any length, rate and unit");
    app.add_option("--seed", task->seed);
    return [task] {
        fmt::print("{}", campaign_text(run_noise_campaign(*task)));
        return 0;
    };
}

Work accept_units(CLI::App& app) {
    const auto task = std::make_shared<AcceptCampaignTask>();
    app.add_option("UNITS", task->n_units)->check(CLI::PositiveNumber);
    app.add_option("--seed", task->seed);
    return [task] {
        task->folder = std::filesystem::temp_directory_path() / fmt::format("zlg-accept-{}", ::getpid());
        std::filesystem::create_directories(task->folder);
        const AcceptCampaign campaign = run_accept_campaign(*task);
        std::filesystem::remove_all(task->folder);
        fmt::print("{}", campaign_text(campaign));
        return campaign.is_good() ? 0 : 1;
    };
}

}  // namespace zlg::trials
