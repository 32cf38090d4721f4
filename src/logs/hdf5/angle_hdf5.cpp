#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <zlg/logs/error.hpp>

#include "angle_columns.hpp"
#include "angle_log_io.hpp"
#include "hdf5_settings.hpp"
#include "hdf5_table_sink.hpp"
#include "hdf5_table_source.hpp"
#include "row_rules.hpp"
#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

constexpr const char* group = "/angles";

// A member of the tick's row within the angle.
template <class Member>
constexpr auto of_row(Member core::AngleRow::*member) {
    return [member](auto& angle) -> auto& { return angle.row.*member; };
}

using core::AngleRow;
constexpr std::tuple fields{
    hdf5::field<std::int64_t>(angles::tick, of_row(&AngleRow::tick)),
    hdf5::field<double>(angles::t_s, &TimedAngle::t_s),
    hdf5::field<double>(angles::dtheta_arcsec, of_row(&AngleRow::dtheta_arcsec)),
    hdf5::field<double>(angles::dtheta_final_arcsec, of_row(&AngleRow::dtheta_final_arcsec)),
    hdf5::field<double>(angles::sigma_arcsec, of_row(&AngleRow::sigma_arcsec)),
    hdf5::field<std::int8_t>(angles::mode, of_row(&AngleRow::mode)),
    hdf5::field<std::uint32_t>(angles::flags, of_row(&AngleRow::flags)),
};

class AngleHdf5Sink final : public hdf5::TableSink<AngleSink> {
public:
    AngleHdf5Sink(const std::string& path, double tick_s, const Settings& settings, bool force,
                  const AngleWriterOptions& options)
        : TableSink{path, force, options.keep_part} {
        hdf5::add_angle_settings(table_, settings, tick_s);
        table_.add_group(group);
        add_fields(group, angles::columns, fields, buffers_, [](std::size_t) { return true; });
        if (options.has_truth) {
            table_.add_group(angles::truth_group);
            truth_ = table_.add_column<double>(angles::truth_group, {angles::truth_name, false, "arcsec"});
        }
        const std::string* legend = find_setting(settings, "flags");
        table_.set_text("/angles/flags", "flags", legend != nullptr ? *legend : angles::flag_legend());
        table_.start();
    }

    void write(const TimedAngle& angle) override {
        table_.require_open();
        angles::require_loggable(angle);
        if (truth_ != nullptr) {
            if (!is_finite(angle.truth_dtheta_arcsec)) refuse_truth(angle);
            truth_[table_.row()] = angle.truth_dtheta_arcsec;
        }
        put(fields, buffers_, angle);
        table_.end_row();
    }

private:
    [[noreturn]] static void refuse_truth(const TimedAngle& angle) {
        throw FormatError(fmt::format("tick {} cannot be logged: true dtheta is {}; allowed is a finite number",
                                      angle.row.tick, angle.truth_dtheta_arcsec));
    }

    decltype(hdf5::parts_of<hdf5::Buffer>(fields)) buffers_{};
    double* truth_ = nullptr;
};

class AngleHdf5Source final : public hdf5::TableSource<AngleSource> {
public:
    explicit AngleHdf5Source(const std::string& path) : TableSource{path, group, angles::columns} {
        open_fields(fields, columns_);
        if (table_.source().has(angles::truth_path)) {
            truth_ = hdf5::Column<double>{table_.source(), angles::truth_path};
            table_.add(truth_);
        }
        table_.measure();
        header_.settings = settings();
        header_.warnings = table_.warnings();
        header_.has_truth = truth_.is_open();
        header_.complete = table_.is_complete();
    }

    bool next(TimedAngle& angle) override {
        if (!next_row(fields, columns_, angle)) return false;
        angle.truth_dtheta_arcsec =
            header_.has_truth ? truth_[n_handed_out_ - 1] : std::numeric_limits<double>::quiet_NaN();
        return true;
    }

private:
    // With the two lines that a CSV log has besides.
    [[nodiscard]] Settings settings() const {
        const hdf5::Source& source = table_.source();
        Settings settings = hdf5::read_settings(source, false);
        const auto legend = source.text_attribute("/angles/flags", "flags");
        const auto tick_s = source.real_attribute("tick_s");
        if (legend && !find_setting(settings, "flags")) settings.emplace_back("flags", *legend);
        if (tick_s && !find_setting(settings, "tick_s")) settings.emplace_back("tick_s", fmt::format("{}", *tick_s));
        return settings;
    }

    void take_columns(std::int64_t first) override {
        take_indices(std::get<angles::tick>(columns_), first);
        take_reals(std::get<angles::t_s>(columns_));
        take_reals(std::get<angles::dtheta_arcsec>(columns_));
        take_reals(std::get<angles::dtheta_final_arcsec>(columns_));
        block_.take(
            std::get<angles::sigma_arcsec>(columns_), [](double v, std::size_t) { return v >= 0.0; },
            [](double v) { return std::string{std::isnan(v) ? not_a_number : sigma_below_zero}; });
        take_signs(std::get<angles::mode>(columns_));
        take_integers(std::get<angles::flags>(columns_));
        take_reals(truth_);
    }

    decltype(hdf5::parts_of<hdf5::Column>(fields)) columns_;
    hdf5::Column<double> truth_;
};

}  // namespace

std::unique_ptr<AngleSource> open_angle_hdf5(const std::string& path) {
    return std::make_unique<AngleHdf5Source>(path);
}

std::unique_ptr<AngleSink> create_angle_hdf5(const std::string& path, double tick_s, const Settings& settings,
                                             bool force, const AngleWriterOptions& options) {
    return std::make_unique<AngleHdf5Sink>(path, tick_s, settings, force, options);
}

}  // namespace zlg::logs
