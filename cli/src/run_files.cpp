#include "run_files.hpp"

#include <filesystem>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/table_file.hpp>

namespace zlg::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* names[] = {"raw.csv", "angles.csv", "switches.csv", "summary.json", "report.html"};

// True where the folder was made, false where it was there.
bool make_folder(const std::string& folder) {
    std::error_code error;
    const bool made = fs::create_directory(folder, error);
    if (error) throw logs::IoError{fmt::format("{}: cannot make the folder: {}", folder, error.message())};
    return made;
}

std::string make_new_folder() {
    for (int k = 1; k <= 999; ++k) {
        const std::string folder = fmt::format("zlg-run-{:03}", k);
        if (make_folder(folder)) return folder;
    }
    throw logs::IoError{"zlg-run-001 to zlg-run-999 exist; name a folder with --out"};
}

std::string switch_table(const std::vector<study::SwitchLine>& switches) {
    std::string text =
        "tick,mode,miss_lambda,half_wave_v,half_wave_sigma_v,gap_ticks,dp_arcsec,relock_arcsec,sigma_arcsec,true_error_"
        "arcsec\n";
    for (const study::SwitchLine& s : switches)
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", s.tick, s.mode, s.miss_lambda, s.half_wave_v,
                            s.half_wave_sigma_v, s.gap_ticks, s.dp_arcsec, s.relock_arcsec, s.sigma_arcsec,
                            s.true_error_arcsec);
    return text;
}

}  // namespace

RunFiles::RunFiles(const std::string& out, bool force, const config::Config& config) : folder_{out}, force_{force} {
    if (folder_.empty()) {
        folder_ = make_new_folder();
        made_folder_ = true;
    } else {
        made_folder_ = make_folder(folder_);
    }
    for (const char* name : names)
        if (!force_ && fs::exists(path(name)))
            throw logs::IoError{fmt::format("{} exists; --force overwrites it", path(name))};
    raw_.emplace(path("raw.csv"), config::to_settings(config), force_);
    // The raw log has the columns for it, so this is what an unset method means; the angle log says what was done.
    config::Config done = config;
    done.compensation.relock = config.compensation.relock.value_or(core::RelockMethod::mean_square);
    angles_.emplace(path("angles.csv"), config.gyro.tick_s, config::to_settings(done), force_);
}

RunFiles::~RunFiles() {
    if (finished_) return;
    raw_.reset();
    angles_.reset();
    // A folder that was made for a run that failed is empty now.
    std::error_code ignored;
    if (made_folder_) fs::remove(folder_, ignored);
}

void RunFiles::finish(const std::vector<study::SwitchLine>& switches, const std::string& summary,
                      const std::string& page) {
    write_text("switches.csv", switch_table(switches));
    write_text("summary.json", summary);
    write_text("report.html", page);
    raw_->close();
    angles_->close();
    finished_ = true;
}

std::string RunFiles::list() { return fmt::format("{}", fmt::join(names, ", ")); }

std::string RunFiles::path(const char* name) const { return fs::path{folder_} / name; }

void RunFiles::write_text(const char* name, const std::string& text) const {
    logs::TableFile file{path(name), force_};
    file.append(text);
    file.close();
}

}  // namespace zlg::cli
