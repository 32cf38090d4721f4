#include <zlg/sweep/sweep.hpp>

#include <unistd.h>

#include <filesystem>
#include <iterator>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/numeric/parallel.hpp>
#include <zlg/sweep/checkpoint.hpp>
#include <zlg/sweep/motion_files.hpp>
#include <zlg/text/inputs.hpp>

namespace zlg::sweep {
namespace {

namespace fs = std::filesystem;

std::string part_of(const std::string& out) { return out + ".part"; }

void require_regular(const std::string& path) {
    std::error_code ignored;
    if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
        throw logs::IoError(fmt::format("cannot create {}: it is no regular file", path));
    const fs::path folder = fs::path{path}.parent_path();
    if (!folder.empty() && !fs::is_directory(folder, ignored))
        throw logs::IoError(fmt::format("cannot create {}: there is no folder {}", path, folder.string()));
}

// A link stays one, and what it names is written, there already or not.
std::string target_of(const std::string& path) {
    constexpr int most_links = 40;
    std::error_code error;
    fs::path at = path;
    for (int k = 0; fs::is_symlink(at, error); ++k) {
        if (k == most_links) throw logs::IoError(fmt::format("cannot create {}: too many links", path));
        at = at.parent_path() / fs::read_symlink(at, error);
    }
    return at.string();
}

void require_same_sweep(const std::string& path, const std::string& theirs, const std::string& ours) {
    if (const std::string what = difference(theirs, ours); !what.empty())
        throw logs::IoError(
            fmt::format("{} is of another sweep: it {}; name another file with --out, or use --force", path, what));
}

// What RESULTS holds already; nothing where there is none.
std::optional<Results> results_until_now(const Task& task, const std::string& out, const std::string& description) {
    std::error_code ignored;
    if (task.force || !fs::exists(out, ignored)) return std::nullopt;
    Results results = read_results(out);
    require_same_sweep(out, results.description, description);
    const std::int64_t n = task.description.n_gyros;
    if (!results.rows.empty() && results.rows.rbegin()->first >= n)
        throw config::ConfigError(
            fmt::format("sweep.gyros = {}: {} has gyro {} already; allowed are more, or another file by --out", n, out,
                        results.rows.rbegin()->first));
    return results;
}

std::vector<std::int64_t> missing(const Task& task, const Rows& rows) {
    std::vector<std::int64_t> gyros;
    for (std::int64_t k = task.part.k - 1; k < task.description.n_gyros; k += task.part.n)
        if (!rows.contains(k)) gyros.push_back(k);
    return gyros;
}

// The crew of this process: its threads.
Crew threads_of(const Task& task) {
    return [&task](const Gyros& gyros, const std::vector<std::int64_t>& asked, const std::function<void(Row)>& take) {
        try {
            numeric::in_parallel(asked.size(), task.threads,
                                 [&](std::size_t k) { take(gyros.run(asked[k], task.is_stopped)); });
        } catch (const Stopped&) {
            return false;
        }
        return true;
    };
}

}  // namespace

Outcome run(const Task& task) {
    const std::string out = target_of(task.out);
    const Gyros gyros{with_motion_checksums(task.description)};
    const std::string description = to_toml(gyros.description());
    const std::string part = part_of(out);
    for (const std::string& path : {out, part}) {
        require_regular(path);
        text::refuse_input(path);
    }
    if (task.force) ::unlink(part.c_str());
    Outcome outcome{.checkpoint = part};
    const std::optional<Results> before = results_until_now(task, out, description);
    if (before) outcome.rows = before->rows;
    const bool is_current = before && before->description == description;
    if (is_current && !fs::exists(part) && missing(task, outcome.rows).empty()) return outcome;

    Checkpoint checkpoint{part, description};
    add_rows(outcome.rows, checkpoint.rows(), part);
    const std::vector<std::int64_t> asked = missing(task, outcome.rows);
    const Crew crew = task.crew ? task.crew : threads_of(task);
    std::mutex recording;
    // Rows come from any thread.
    outcome.is_stopped = !crew(gyros, asked, [&](Row row) {
        const std::scoped_lock one_at_a_time{recording};
        checkpoint.append(row);
        outcome.rows.emplace(row.gyro, std::move(row));
        ++outcome.n_run;
        if (task.on_progress) task.on_progress(outcome.n_run, std::ssize(asked));
    });
    if (outcome.is_stopped) return outcome;
    write_results(out, gyros, outcome.rows);
    checkpoint.remove();
    return outcome;
}

Merged merge(const std::vector<std::string>& paths, const std::string& out, bool force) {
    const std::string target = target_of(out);
    require_regular(target);
    std::error_code ignored;
    if (!force && fs::exists(out, ignored))
        throw logs::IoError(fmt::format("{} exists; use --force to overwrite", out));
    text::refuse_input(target);
    std::string first;
    Merged merged;
    for (const std::string& path : paths) {
        logs::require_regular_file(path);
        Results results = is_checkpoint(path) ? read_checkpoint(path) : read_results(path);
        // Also the numbers of gyros and the limits: the bytes must not depend on which file comes first.
        if (first.empty()) {
            first = results.description;
            merged.description = recorded_description(first, path);
        } else if (results.description != first) {
            throw logs::IoError(fmt::format("{} is of another sweep than {}: its description differs, {}", path,
                                            paths.front(), first_difference(results.description, first)));
        }
        add_rows(merged.rows, results.rows, path);
    }
    write_results(target, Gyros{merged.description}, merged.rows);
    return merged;
}

}  // namespace zlg::sweep
