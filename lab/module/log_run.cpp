// A recorded log on the page.
#include "log_run.hpp"

#include <limits>
#include <utility>

#include <fmt/format.h>

#include <zlg/config/log_settings.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/logs/file_nature.hpp>
#include <zlg/logs/log_kind.hpp>

#include "compared.hpp"

namespace zlg::lab {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// The log's settings over the defaults, and over them the page's, as the program layers them.
config::Config layered(const config::Settings& of_log, const std::string& name, std::span<const std::string> settings,
                       bool scale_is_used) {
    const config::Settings checked = config::checked_log_settings(of_log, name);
    config::Config config;
    config::apply_log(config, checked, name);
    for (const std::string& setting : settings) config::apply_set(config, setting);
    config::require_log_facts(config, name, scale_is_used);
    config::check_compensation(config);
    config::check_against_log(config, checked, name);
    return config;
}

core::GyroCompensationConfig compared_compensation(config::Config config, const logs::RawHeader& log,
                                                   const std::string& name, core::RelockMethod relock,
                                                   core::BridgeMethod bridge) {
    config.compensation.relock = relock;
    config.compensation.bridge = bridge;
    return recorded::log_compensation(with_points_of_paper(config), log, name).compensation;
}

void append(std::vector<std::string>& notes, std::span<const std::string> more) {
    notes.insert(notes.end(), more.begin(), more.end());
}

}  // namespace

LogRun::LogRun(std::string name, std::span<const std::string> settings) : name_{std::move(name)} {
    if (logs::foreign_nature(name_).starts_with("HDF5")) raw_.emplace(name_);  // refuses it
    logs::refuse_foreign(name_);
    switch (logs::recognise_text(name_)) {
        case logs::LogKind::raw_csv: open_raw(logs::RawReader{name_}, settings); break;
        case logs::LogKind::angle_csv: open_angles(settings); break;
        default: open_foreign(settings);
    }
}

void LogRun::open_raw(logs::RawReader&& raw, std::span<const std::string> settings) {
    const logs::RawHeader& log = raw_.emplace(std::move(raw)).header();
    recorded::LogCompensation asked =
        recorded::log_compensation(layered(log.settings, name_, settings, true), log, name_);
    for (const auto& lines : {log.warnings, asked.notes, asked.warnings}) append(notes_, lines);
    config_ = std::move(asked.config);
    lacks_detuning_ = asked.lacks_detuning;
    configured_.emplace(asked.compensation);
    const auto relock = log.has_detuning ? core::RelockMethod::detuning : core::RelockMethod::none;
    compared_.emplace_back(
        compared_compensation(config_, log, name_, core::RelockMethod::none, core::BridgeMethod::none));
    compared_.emplace_back(compared_compensation(config_, log, name_, relock, core::BridgeMethod::quadratic));
}

void LogRun::open_angles(std::span<const std::string> settings) {
    const logs::AngleHeader& log = angles_.emplace(name_).header();
    config_ = layered(log.settings, name_, settings, false);
    append(notes_, log.warnings);
    if (const auto note = config::former_keys_note(log.settings, name_)) notes_.push_back(*note);
}

// A setting without a section says what the file means.
void LogRun::open_foreign(std::span<const std::string> settings) {
    logs::Mapping mapping;
    std::vector<std::string> over;
    for (const std::string& setting : settings) {
        if (setting.find('.') < setting.find('='))
            over.push_back(setting);
        else
            logs::apply_mapping_pair(mapping, setting);
    }
    const logs::ForeignLook look = logs::look_at_foreign(name_, mapping);
    logs::require_whole(look);
    for (const auto& lines : {look.table.notes, look.said}) append(notes_, lines);
    if (look.makes == logs::Makes::raw) {
        logs::ImportedRaw made = logs::imported_raw(look);
        for (const auto& lines : {made.notes, made.warnings}) append(notes_, lines);
        open_raw({name_, std::move(made.header), std::move(made.rows)}, over);
        return;
    }
    const logs::ImportedAxes made = logs::imported_axes(look);
    append(notes_, made.notes);
    if (made.axes.size() != 1)
        throw logs::MappingError{
            fmt::format("{}: {} axes; the page shows one: --map axis=COLUMN", name_, made.axes.size())};
    take_axis(made.axes.front(), over);
}

void LogRun::take_axis(const logs::ImportedAxis& axis, std::span<const std::string> settings) {
    append(notes_, axis.warnings);
    notes_.push_back(fmt::format("{}, {}", axis.name, axis.holds));
    config_ = layered({{"gyro.tick_s", fmt::format("{}", 1.0 / axis.rate_hz)}}, name_, settings, false);
    rows_.clear();
    logs::angle_rows(axis, [&](const core::AngleRow& row) { rows_.push_back(row); });
}

bool LogRun::advance(std::int64_t rows) {
    for (; rows > 0 && !ended_; --rows)
        if (!take_row()) end();
    return !ended_;
}

bool LogRun::take_row() {
    core::HalfRecord half;
    logs::TimedAngle angle;
    if (raw_ && raw_->next(half))
        take(half);
    else if (angles_ && angles_->next(angle))
        take(angle);
    else if (next_row_ < rows_.size())
        take(logs::TimedAngle{.row = rows_[next_row_++]});
    else
        return false;
    return true;
}

void LogRun::take(const core::HalfRecord& half) {
    if (first_) {
        const std::int64_t tick = half.half / 2;
        seen(tick) = {config_.gyro.scale_arcsec * static_cast<double>(first_->counts + half.counts),
                      half.detuning_lambda, half.piezo_v};
        first_.reset();
    } else {
        first_ = half;
    }
    configured_->take(
        half, {}, [this](const core::AngleRow& row) { final_.push_back(row); },
        [this](const core::GapReport& gap) { note_switch(gap); });
    for (Compared& each : compared_)
        each.replay.take(half, {},
                         [&each](const core::AngleRow& row) { each.final_arcsec.push_back(row.dtheta_final_arcsec); });
    add_ticks();
}

void LogRun::take(const logs::TimedAngle& angle) {
    seen(angle.row.tick) = {unknown, unknown, unknown};
    final_.push_back(angle.row);
    add_ticks();
}

void LogRun::note_switch(const core::GapReport& gap) {
    if (!gap.mode_changed) return;
    switches_.insert(switches_.end(), {static_cast<double>(gap.first_tick), static_cast<double>(gap.n_ticks),
                                       static_cast<double>(gap.mode_after), gap.dp_arcsec});
}

void LogRun::add_ticks() {
    const auto waits = [this] {
        for (const Compared& each : compared_)
            if (each.final_arcsec.empty()) return true;
        return false;
    };
    while (!final_.empty() && !waits()) {
        const core::AngleRow row = final_.take_front();
        const SeenTick& at = seen(row.tick);
        delivered_arcsec_.add(row.dtheta_arcsec);
        final_arcsec_.add(row.dtheta_final_arcsec);
        ticks_.insert(ticks_.end(),
                      {static_cast<double>(row.tick), at.read_arcsec, row.dtheta_arcsec, row.dtheta_final_arcsec,
                       row.sigma_arcsec, static_cast<double>(row.flags), static_cast<double>(row.mode),
                       at.detuning_lambda, at.piezo_v, delivered_arcsec_.value(), final_arcsec_.value()});
        for (Compared& each : compared_) {
            each.less_configured.add(each.final_arcsec.take_front() - row.dtheta_final_arcsec);
            ticks_.push_back(each.less_configured.value());
        }
        if (compared_.empty()) ticks_.insert(ticks_.end(), {unknown, unknown});
    }
}

void LogRun::end() {
    ended_ = true;
    if (!raw_) return;
    recorded::require_a_tick(*configured_, name_);
    configured_->end([this](const core::AngleRow& row) { final_.push_back(row); },
                     [this](const core::GapReport& gap) { note_switch(gap); });
    for (Compared& each : compared_)
        each.replay.end([&each](const core::AngleRow& row) { each.final_arcsec.push_back(row.dtheta_final_arcsec); });
    add_ticks();
    if (std::string odd = configured_->odd_half(name_); !odd.empty()) notes_.push_back(std::move(odd));
    if (std::string line = configured_->uncorrected(name_); lacks_detuning_ && !line.empty())
        notes_.push_back(std::move(line));
    append(notes_, configured_->contradictions(name_));
    if (!raw_->line_is_ended()) notes_.push_back(name_ + ": the last line has no end; the file may have been cut off");
}

void LogRun::forget() {
    ticks_.clear();
    switches_.clear();
}

double LogRun::fraction_read() const {
    if (raw_) return raw_->fraction_read();
    if (angles_) return angles_->fraction_read();
    return static_cast<double>(next_row_) / static_cast<double>(rows_.size());
}

}  // namespace zlg::lab
