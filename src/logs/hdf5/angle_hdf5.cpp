#include <fmt/format.h>

#include <limits>
#include <zlg/logs/error.hpp>

#include "hdf5_settings.hpp"
#include "hdf5_table_sink.hpp"
#include "hdf5_table_source.hpp"
#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

// What the twin turned in each tick.
constexpr const char* truth_group = "/truth";
constexpr const char* truth_name = "dtheta_arcsec";
constexpr const char* truth_path = "/truth/dtheta_arcsec";

class AngleHdf5Sink final : public hdf5::TableSink<AngleTable> {
public:
    AngleHdf5Sink(const std::string& path, bool force, const Settings& settings, const AngleWriterOptions& options)
        : TableSink{path, force, options, {}} {
        hdf5::add_angle_settings(table_, settings, options.format_version);
        add_columns();
        if (options.has_truth) {
            table_.add_group(truth_group);
            truth_ = table_.add_column<double>(truth_group, truth_name, "arcsec");
        }
        table_.set_text("/angles/flags", "flags", *find_setting(settings, "flags"));
        table_.start();
    }

    void write(const TimedAngle& angle, const core::LightSamples&) override {
        require_loggable(angle);
        if (truth_ != nullptr) {
            if (!Real{}.allows(angle.truth_dtheta_arcsec, angle.row.tick)) refuse_truth(angle);
            truth_[table_.row()] = angle.truth_dtheta_arcsec;
        }
        put(angle);
        table_.end_row();
    }

private:
    [[noreturn]] static void refuse_truth(const TimedAngle& angle) {
        throw FormatError(fmt::format("tick {} cannot be logged: true dtheta is {}; allowed is a finite number",
                                      angle.row.tick, angle.truth_dtheta_arcsec));
    }

    double* truth_ = nullptr;
};

class AngleHdf5Source final : public hdf5::TableSource<AngleTable> {
public:
    explicit AngleHdf5Source(const std::string& path) : TableSource{path, known_columns<AngleTable>} {
        if (source_.has(truth_path)) add({source_, truth_path}, truth_);
        measure();
        header_.format_version = hdf5::read_format_version(source_);
        header_.settings = settings();
        header_.has_truth = truth_.is_open();
    }

    bool next(TimedAngle& angle) override {
        if (!TableSource::next(angle)) return false;
        angle.truth_dtheta_arcsec =
            header_.has_truth ? truth_[static_cast<std::size_t>(last_row())] : std::numeric_limits<double>::quiet_NaN();
        return true;
    }

private:
    // With the two lines that a CSV log has besides.
    [[nodiscard]] Settings settings() const {
        Settings settings = hdf5::read_settings(source_, false);
        const auto legend = source_.text_attribute("/angles/flags", "flags");
        const auto tick_s = source_.real_attribute("tick_s");
        if (legend && !find_setting(settings, "flags")) settings.emplace_back("flags", *legend);
        if (tick_s && !find_setting(settings, "tick_s")) settings.emplace_back("tick_s", fmt::format("{}", *tick_s));
        return settings;
    }

    void take_others(hdf5::Block& block) override { block.take(truth_, Real{}); }

    hdf5::Column<double> truth_;
};

}  // namespace

std::unique_ptr<LogSource<AngleTable>> open_angle_hdf5(const std::string& path) {
    return std::make_unique<AngleHdf5Source>(path);
}

std::unique_ptr<LogSink<AngleTable>> create_angle_hdf5(const std::string& path, bool force, const Settings& settings,
                                                       const AngleWriterOptions& options) {
    return std::make_unique<AngleHdf5Sink>(path, force, settings, options);
}

}  // namespace zlg::logs
