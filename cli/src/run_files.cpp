#include "run_files.hpp"

#include <filesystem>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/core/health.hpp>
#include <zlg/logs/error.hpp>

#include "options.hpp"

namespace zlg::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* raw_name = "raw.csv";
constexpr const char* angles_name = "angles.csv";
constexpr const char* health_name = "health.csv";
constexpr const char* switches_name = "switches.csv";
constexpr const char* summary_name = "summary.json";
constexpr const char* page_name = "report.html";
constexpr const char* names[] = {raw_name, angles_name, health_name, switches_name, summary_name, page_name};

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
        "tick,mode,miss_lambda,half_wave_v,half_wave_sigma_v,gap_ticks,dp_arcsec,relock_arcsec,sigma_arcsec,"
        "true_error_arcsec\n";
    for (const study::SwitchLine& s : switches)
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", s.tick, s.mode, s.miss_lambda, s.half_wave_v,
                            s.half_wave_sigma_v, s.gap_ticks, s.dp_arcsec, s.relock_arcsec, s.sigma_arcsec,
                            s.true_error_arcsec);
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

RunFiles::RunFiles(const std::string& out, bool force, const config::Config& config)
    : folder_{out}, force_{force}, tick_s_{config.gyro.tick_s} {
    if (folder_.empty()) {
        folder_ = make_new_folder();
        made_folder_ = true;
    } else {
        made_folder_ = make_folder(folder_);
    }
    try {
        open(config);
    } catch (...) {
        std::error_code ignored;
        if (made_folder_) fs::remove(folder_, ignored);
        throw;
    }
}

void RunFiles::open(const config::Config& config) {
    raw_.emplace(path(raw_name), config::to_settings(config), force_);
    // The raw log has the columns for it, so this is what an unset method means; the angle log says what was done.
    config::Config done = config;
    done.compensation.relock = config.compensation.relock.value_or(core::RelockMethod::mean_square);
    angles_.emplace(path(angles_name), config.gyro.tick_s, angle_settings(done), force_);
    health_.emplace(path(health_name), force_);
    health_->append(health_head());
    switches_.emplace(path(switches_name), force_);
    summary_.emplace(path(summary_name), force_);
    page_.emplace(path(page_name), force_);
    for (const char* name : names)
        if (!fs::exists(path(name))) new_.push_back(path(name));
}

RunFiles::~RunFiles() {
    if (finished_) return;
    for (auto* file : {&health_, &switches_, &summary_, &page_}) file->reset();
    raw_.reset();
    angles_.reset();
    std::error_code ignored;
    for (const std::string& name : new_) fs::remove(name, ignored);
    if (made_folder_) fs::remove(folder_, ignored);
}

void RunFiles::write_health(std::int64_t half, std::uint32_t bits) {
    health_->append(fmt::format("{},{},{}\n", half, 0.5 * tick_s_ * static_cast<double>(half + 1), bits));
}

void RunFiles::finish(const std::vector<study::SwitchLine>& switches, const std::string& summary,
                      const std::string& page) {
    switches_->append(switch_table(switches));
    summary_->append(summary);
    page_->append(page);
    raw_->close();
    angles_->close();
    for (auto* file : {&health_, &switches_, &summary_, &page_}) (*file)->close();
    finished_ = true;
}

std::string RunFiles::list() { return fmt::format("{}", fmt::join(names, ", ")); }

std::string RunFiles::path(const char* name) const { return fs::path{folder_} / name; }

}  // namespace zlg::cli
