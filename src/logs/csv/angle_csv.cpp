#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <zlg/logs/error.hpp>

#include "angle_columns.hpp"
#include "angle_log_io.hpp"
#include "csv_reader.hpp"
#include "row_rules.hpp"
#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

class AngleCsvSource final : public AngleSource {
public:
    explicit AngleCsvSource(const std::string& path) : csv_{path, angles::columns} {
        header_.settings = csv_.settings();
        header_.warnings = csv_.warnings();
    }

    bool next(TimedAngle& angle) override {
        if (!csv_.next()) return false;
        angle.row.tick = next_tick();
        angle.t_s = csv_.real(angles::t_s);
        angle.row.dtheta_arcsec = csv_.real(angles::dtheta_arcsec);
        angle.row.dtheta_final_arcsec = csv_.real(angles::dtheta_final_arcsec);
        angle.row.sigma_arcsec = csv_.real_or_infinite(angles::sigma_arcsec);
        if (!(angle.row.sigma_arcsec >= 0.0)) csv_.fail(angles::sigma_arcsec, sigma_below_zero);
        angle.row.mode = csv_.sign(angles::mode);
        angle.row.flags =
            static_cast<std::uint32_t>(csv_.integer(angles::flags, 0, std::numeric_limits<std::uint32_t>::max()));
        angle.truth_dtheta_arcsec = std::numeric_limits<double>::quiet_NaN();
        ++expected_tick_;
        return true;
    }

    [[nodiscard]] double fraction_read() const override { return csv_.fraction_read(); }

private:
    [[nodiscard]] std::int64_t next_tick() const {
        const std::int64_t value = csv_.integer(angles::tick, 0, std::numeric_limits<std::int64_t>::max());
        if (value != expected_tick_) csv_.fail(angles::tick, out_of_order(value, expected_tick_));
        return value;
    }

    CsvReader csv_;
    std::int64_t expected_tick_ = 0;
};

class AngleCsvSink final : public AngleSink {
public:
    AngleCsvSink(const std::string& path, double tick_s, const Settings& settings, bool force,
                 const AngleWriterOptions& options)
        : file_{path, force} {
        write_settings(file_, settings);
        if (!find_setting(settings, "flags")) file_.append(fmt::format("# flags = {}\n", angles::flag_legend()));
        if (!find_setting(settings, "tick_s") && !std::isnan(tick_s))
            file_.append(fmt::format("# tick_s = {}\n", tick_s));
        std::string names;
        for (const Column& column : angles::columns) {
            names += fmt::format("{}{}", names.empty() ? "" : ",", column.name);
        }
        file_.append(names + "\n");
        if (options.keep_csv_part) file_.keep_what_follows();
    }

    void write(const TimedAngle& angle) override {
        angles::require_loggable(angle);
        // One integer of at most 20 letters, four reals of at most 24, the sign, at most 10 of flags, and the commas.
        std::array<char, 160> row;
        const core::AngleRow& r = angle.row;
        const char* end = fmt::format_to(row.data(), FMT_COMPILE("{},{},{},{},{},{},{}\n"), r.tick, angle.t_s,
                                         r.dtheta_arcsec, r.dtheta_final_arcsec, r.sigma_arcsec, r.mode, r.flags);
        file_.append({row.data(), static_cast<std::size_t>(end - row.data())});
    }

    void flush() override { file_.flush(); }
    void close() override { file_.close(); }
    [[nodiscard]] const std::string& part_path() const override { return file_.part_path(); }

private:
    TableFile file_;
};

}  // namespace

std::unique_ptr<AngleSource> open_angle_csv(const std::string& path) { return std::make_unique<AngleCsvSource>(path); }

std::unique_ptr<AngleSink> create_angle_csv(const std::string& path, double tick_s, const Settings& settings,
                                            bool force, const AngleWriterOptions& options) {
    return std::make_unique<AngleCsvSink>(path, tick_s, settings, force, options);
}

}  // namespace zlg::logs
