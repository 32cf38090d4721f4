// Every method of compensation against the bound: tables in Markdown to stdout, and with --out a page.
//
// The number of threads changes no figure. Exit 1 where a criterion is not met.

#include <algorithm>
#include <filesystem>
#include <type_traits>

#include <zlg/logs/table_file.hpp>
#include <zlg/trials/accuracy.hpp>
#include <zlg/trials/physics_pictures.hpp>

#include "command.hpp"

namespace {

using namespace zlg;

// Options of a motion are of the file named last.
void add_motion_options(CLI::App& app, std::vector<trials::Recording>& recordings) {
    const auto of_last = [&](const char* name, auto trials::Recording::*member, const char* what) {
        using Value = std::remove_reference_t<decltype(recordings.back().*member)>;
        return app
            .add_option_function<Value>(
                name,
                [&recordings, member, name](const Value& value) {
                    if (recordings.empty()) throw CLI::RequiresError(name, "--motion");
                    recordings.back().*member = value;
                },
                what)
            ->trigger_on_parse();
    };
    app.add_option_function<std::string>(
           "--motion",
           [&](const std::string& path) {
               recordings.push_back({.name = std::filesystem::path{path}.filename().string(), .path = path});
           },
           "a recording; the options below are of the one named last")
        ->trigger_on_parse();
    of_last("--columns", &trials::Recording::columns, "the first is 1")->delimiter(',');
    of_last("--rate-hz", &trials::Recording::rate_hz, "rows a second");
    of_last("--scale", &trials::Recording::scale_arcsec, "arcsec of a unit of the column");
    of_last("--count", &trials::Recording::count_arcsec, "arcsec of a count of the counter that reads it");
    of_last("--comment", &trials::Recording::comment, "first character of a line to leave out");
    of_last("--skip-lines", &trials::Recording::skip_lines, "lines to leave out first");
    app.add_flag_callback("--holds-rate",
                          [&] {
                              if (recordings.empty()) throw CLI::RequiresError("--holds-rate", "--motion");
                              recordings.back().holds_rate = true;
                          })
        ->trigger_on_parse();
}

void write(const std::filesystem::path& path, const std::string& text) {
    logs::TableFile file{path.string(), true};
    file.append(text);
    file.close();
}

void show_progress(trials::AccuracyTask& task) {
    task.on_progress = [shown = -1](double share) mutable {
        const int percent = static_cast<int>(100.0 * share);
        if (percent >= shown + 5) fmt::print(stderr, "{} %\n", shown = percent);
    };
}

int run(const trials::AccuracyTask& task, const std::filesystem::path& out) {
    const trials::Accuracy accuracy = trials::measure_accuracy(task);
    const std::string text = trials::markdown(accuracy);
    fmt::print("{}", text);
    if (!out.empty()) {
        std::filesystem::create_directories(out);
        write(out / "accuracy.md", text);
        write(out / "accuracy.html", report::html(trials::accuracy_page(accuracy)));
        if (!task.quick)
            write(out / "frequency.svg", trials::svg_file({.panels = {trials::frequency_figure(accuracy)}}));
    }
    return std::ranges::count(accuracy.criteria, trials::Verdict::missed, &trials::Criterion::verdict) == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    trials::AccuracyTask task;
    std::string out;
    CLI::App app{"Every method of compensation against the bound", "zlg_accuracy"};
    app.add_flag("--quick", task.quick, "a tenth of the trials, without the grid (b)");
    app.add_option("--share", task.share, "of the trials of each case")->check(CLI::PositiveNumber);
    app.add_flag("--long", task.long_runs, "the twin in closed loop over 36 000 s too");
    app.add_option("--out", out, "folder for accuracy.md, accuracy.html and frequency.svg");
    app.add_option("--seed", task.seed);
    app.add_option("--threads", task.threads)->check(CLI::PositiveNumber);
    add_motion_options(app, task.recordings);
    show_progress(task);
    return trials::run_command(app, argc, argv, [&] { return run(task, out); });
}
