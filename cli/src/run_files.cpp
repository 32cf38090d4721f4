#include "run_files.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/core/health.hpp>
#include <zlg/logs/error.hpp>

#include "options.hpp"

namespace zlg::cli {
namespace {

namespace fs = std::filesystem;

enum File : std::size_t { raw_file, angles_file, health_file, switches_file, summary_file, page_file };

std::array<std::string, 6> file_names(logs::LogFormat format) {
    const char* suffix = format == logs::LogFormat::csv ? ".csv" : ".h5";
    return {fmt::format("raw{}", suffix),
            fmt::format("angles{}", suffix),
            "health.csv",
            "switches.csv",
            "summary.json",
            "report.html"};
}

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

// What was not measured is an empty field; what has no bound is `inf`.
std::string cell(double value) { return std::isnan(value) ? std::string{} : fmt::format("{}", value); }

std::string switch_table(const std::vector<study::SwitchLine>& switches) {
    std::string text =
        "tick,mode,miss_lambda,half_wave_v,half_wave_sigma_v,gap_ticks,dp_arcsec,relock_arcsec,sigma_arcsec,"
        "true_error_arcsec\n";
    for (const study::SwitchLine& s : switches)
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", s.tick, s.mode, cell(s.miss_lambda), cell(s.half_wave_v),
                            cell(s.half_wave_sigma_v), s.gap_ticks, cell(s.dp_arcsec), cell(s.relock_arcsec),
                            cell(s.sigma_arcsec), cell(s.true_error_arcsec));
    return text;
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
                   int light_samples)
    : folder_{out}, force_{force}, tick_s_{config.gyro.tick_s}, names_{file_names(format)} {
    make_own_folder();
    try {
        open(config, light_samples);
    } catch (...) {
        discard();
        throw;
    }
}

// A signal finds it either not made or known as new.
void RunFiles::make_own_folder() {
    const logs::Together made_and_known;
    made_folder_ = folder_.empty();
    if (made_folder_)
        folder_ = make_new_folder();
    else
        made_folder_ = make_folder(folder_);
    if (made_folder_) new_folder_.emplace(folder_);
}

void RunFiles::open(const config::Config& config, int light_samples) {
    raw_.emplace(
        path(names_[raw_file]), config::to_settings(config), force_, raw_columns(config),
        logs::RawWriterOptions{.light_samples = light_samples, .light_b = light_samples > 0, .keep_part = true});
    angles_.emplace(path(names_[angles_file]), config.gyro.tick_s, rig::angle_settings(config), force_,
                    logs::AngleWriterOptions{.has_truth = true, .keep_part = true});
    health_.emplace(path(names_[health_file]), force_);
    health_->append(health_head());
    switches_.emplace(path(names_[switches_file]), force_);
    summary_.emplace(path(names_[summary_file]), force_);
    page_.emplace(path(names_[page_file]), force_);
}

RunFiles::~RunFiles() {
    if (!finished_) discard();
}

// A folder can go when nothing is in it any more.
void RunFiles::discard() {
    const logs::Together all_or_none;
    for (auto* file : {&health_, &switches_, &summary_, &page_}) file->reset();
    raw_.reset();
    angles_.reset();
    std::error_code ignored;
    for (const std::string& name : completed_) fs::remove(name, ignored);
    if (made_folder_) fs::remove(folder_, ignored);
}

void RunFiles::write_health(std::int64_t half, std::uint32_t bits) {
    health_->append(fmt::format("{},{},{}\n", half, 0.5 * tick_s_ * static_cast<double>(half + 1), bits));
}

void RunFiles::finish(const std::vector<study::SwitchLine>& switches, const std::string& summary,
                      const std::string& page) {
    const logs::Together all_or_none;
    switches_->append(switch_table(switches));
    summary_->append(summary);
    page_->append(page);
    // The logs last: what fails here leaves HDF5 logs as they are, and what else was completed is taken back.
    const auto complete = [&](auto& file, File which) {
        const bool is_new = !fs::exists(path(names_[which]));
        file->close();
        if (is_new && !names_[which].ends_with(".h5")) completed_.push_back(path(names_[which]));
    };
    complete(health_, health_file);
    complete(switches_, switches_file);
    complete(summary_, summary_file);
    complete(page_, page_file);
    complete(angles_, angles_file);
    complete(raw_, raw_file);
    finished_ = true;
}

std::string RunFiles::list() const { return fmt::format("{}", fmt::join(names_, ", ")); }

std::string RunFiles::path(const std::string& name) const { return fs::path{folder_} / name; }

}  // namespace zlg::cli
