#include "run_files.hpp"

#include <filesystem>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/core/health.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/rig/asked_compensation.hpp>

#include "options.hpp"
#include "switch_csv.hpp"

namespace zlg::cli {
namespace {

namespace fs = std::filesystem;

enum File : std::size_t { raw_file, angles_file, health_file, switches_file, summary_file, page_file, lab_file };

std::array<std::string, 7> file_names(logs::LogFormat format) {
    const char* suffix = format == logs::LogFormat::csv ? ".csv" : ".h5";
    return {fmt::format("raw{}", suffix),
            fmt::format("angles{}", suffix),
            "health.csv",
            "switches.csv",
            "summary.json",
            "report.html",
            "lab.html"};
}

void make_new_folder(std::optional<OwnFolder>& folder) {
    for (int k = 1; k <= 999; ++k)
        if (folder.emplace(fmt::format("zlg-run-{:03}", k)).is_new()) return;
    throw logs::IoError{"zlg-run-001 to zlg-run-999 exist; name a folder with --out"};
}

// One row where the bits change; each holds until the next.
std::string health_head() {
    std::string text = "# health =";
    for (std::size_t bit = 0; bit < core::health_bit_names.size(); ++bit)
        text += fmt::format(" {}:{}", core::health_bit_names[bit], 1u << bit);
    return text + "\nhalf,t_s,health\n";
}

}  // namespace

RunFiles::RunFiles(const std::string& out, bool force, const config::Config& config, logs::LogFormat format,
                   KeptLogs kept, int light_samples)
    : tick_s_{config.gyro.tick_s}, names_{file_names(format)} {
    if (out.empty())
        make_new_folder(folder_);
    else
        folder_.emplace(out);
    open_logs(config, force, kept, light_samples);
    for (const File file : {health_file, switches_file, summary_file, page_file})
        texts_.try_emplace(file, path(file), force);
    texts_.at(health_file).append(health_head());
}

void RunFiles::add_lab(const std::string& page, bool force) {
    texts_.try_emplace(lab_file, path(lab_file), force).first->second.append(page);
}

void RunFiles::open_logs(const config::Config& config, bool force, KeptLogs kept, int light_samples) {
    for (const File log : {raw_file, angles_file})
        if (!force && fs::exists(path(log)))
            throw logs::IoError{fmt::format("{} exists; use --force to overwrite", path(log))};
    if (kept == KeptLogs::all)
        raw_.emplace(path(raw_file), config::to_settings(config), force, raw_columns(config),
                     logs::RawWriterOptions{.light_samples = light_samples,
                                            .light_b = light_samples > 0,
                                            .keep_part = true,
                                            .has_fingerprint = true});
    if (kept != KeptLogs::none)
        angles_.emplace(path(angles_file), config.gyro.tick_s, rig::angle_settings(config), force,
                        logs::AngleWriterOptions{.has_truth = true, .keep_part = true, .has_fingerprint = true});
}

RunFiles::~RunFiles() {
    if (finished_) return;
    const logs::Together all_or_none;
    texts_.clear();
    raw_.reset();
    angles_.reset();
    std::error_code ignored;
    for (const std::string& name : completed_) fs::remove(name, ignored);
}

void RunFiles::write_health(std::int64_t half, std::uint32_t bits) {
    texts_.at(health_file).append(fmt::format("{},{},{}\n", half, 0.5 * tick_s_ * static_cast<double>(half + 1), bits));
}

void RunFiles::finish(const std::vector<study::SwitchLine>& switches, const std::string& summary,
                      const std::string& page, const std::string& fingerprint) {
    const logs::Together all_or_none;
    if (raw_) raw_->set_fingerprint(fingerprint);
    if (angles_) angles_->set_fingerprint(fingerprint);
    texts_.at(switches_file).append(switch_csv(switches, true));
    texts_.at(summary_file).append(summary);
    texts_.at(page_file).append(page);
    // The logs last: what fails here leaves HDF5 logs as they are, and what else was completed is taken back.
    const auto complete = [&](auto& file, std::size_t which) {
        const bool is_new = !fs::exists(path(which));
        file.close();
        if (is_new && !names_[which].ends_with(".h5")) completed_.push_back(path(which));
    };
    for (auto& [which, file] : texts_) complete(file, which);
    const auto complete_log = [&](auto& file, File which) {
        std::error_code ignored;
        if (file)
            complete(*file, which);
        else
            fs::remove(path(which), ignored);
    };
    complete_log(angles_, angles_file);
    complete_log(raw_, raw_file);
    finished_ = true;
}

std::string RunFiles::list() const {
    std::vector<std::string> written;
    if (raw_) written.push_back(names_[raw_file]);
    if (angles_) written.push_back(names_[angles_file]);
    for (const auto& [which, file] : texts_) written.push_back(names_[which]);
    return fmt::format("{}", fmt::join(written, ", "));
}

std::string RunFiles::page() const { return path(page_file); }

}  // namespace zlg::cli
