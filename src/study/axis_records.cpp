#include <zlg/study/axis_records.hpp>

#include <cmath>
#include <cstdint>
#include <filesystem>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>

namespace zlg::study {
namespace {

constexpr std::uint32_t not_measured = core::flag_switching | core::flag_extrapolated | core::flag_interpolated |
                                       core::flag_unrepaired | core::flag_loop_unlocked | core::flag_invalid |
                                       core::flag_mode_mixed;

std::string name_of(const std::string& path) { return std::filesystem::path{path}.filename().string(); }

}  // namespace

TickRates::TickRates(const std::string& path, double tick_s) : tick_s_(tick_s) {
    axis_.name = name_of(path);
    axis_.group = path;
    axis_.holds = fmt::format("final angle of ticks of {} s", tick_s);
    axis_.rate_hz = 1.0 / tick_s;
}

void TickRates::take(const core::AngleRow& row, double truth_arcsec) {
    const double angle = row.dtheta_final_arcsec;
    const bool known = (row.flags & not_measured) == 0;
    axis_.rates_arcsec_s.push_back(known ? angle / tick_s_ : std::numeric_limits<double>::quiet_NaN());
    axis_.bridged_arcsec_s.push_back(angle / tick_s_);
    axis_.mode.push_back(row.mode);
    if (std::isfinite(truth_arcsec)) truth_.push_back(truth_arcsec / tick_s_);
}

void TickRates::finish(std::vector<AxisRecord>& axes) {
    if (std::string line = logs::spikes(axis_.rates_arcsec_s, "its rates"); !line.empty())
        axis_.warnings.push_back(std::move(line));
    if (truth_.size() != axis_.rates_arcsec_s.size() || truth_.empty()) {
        axes.push_back(std::move(axis_));
        return;
    }
    AxisRecord error = axis_;
    error.name += ", error";
    error.group += " error";
    error.is_error = true;
    error.holds = "error of the " + error.holds;
    for (std::size_t k = 0; k < truth_.size(); ++k) {
        error.rates_arcsec_s[k] -= truth_[k];
        error.bridged_arcsec_s[k] -= truth_[k];
    }
    axes.push_back(std::move(axis_));
    axes.push_back(std::move(error));
}

void check_tick(const std::string& path, double tick_s, double first_s, const logs::TimedAngle& last) {
    if (last.row.tick < 1) return;
    const double by_times_s = (last.t_s - first_s) / static_cast<double>(last.row.tick);
    if (std::fabs(by_times_s - tick_s) <= 1e-3 * tick_s) return;
    throw logs::FormatError{fmt::format("{}: tick_s = {}, and the column t_s has ticks of {} s; allowed is one value",
                                        path, tick_s, by_times_s)};
}

AxisRecord axis_of(const std::string& path, logs::ImportedAxis&& from) {
    AxisRecord axis;
    axis.name = fmt::format("{}, {}", name_of(path), from.name);
    axis.group = path;
    axis.holds = std::move(from.holds);
    axis.rate_hz = from.rate_hz;
    axis.rates_arcsec_s = from.rates_arcsec_s.vector();
    axis.phase_arcsec = from.phase_arcsec.vector();
    axis.mode = std::move(from.mode);
    axis.warnings = std::move(from.warnings);
    return axis;
}

}  // namespace zlg::study
