#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <zlg/logs/error.hpp>

#include "angle_columns.hpp"
#include "angle_log_io.hpp"
#include "hdf5_settings.hpp"
#include "hdf5_table_reader.hpp"
#include "row_rules.hpp"
#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

class AngleHdf5Source final : public AngleSource {
public:
    explicit AngleHdf5Source(const std::string& path)
        : table_{path, "/angles", angles::columns}, block_{table_.source()} {
        open_columns();
        header_.settings = settings();
        header_.warnings = table_.warnings();
        header_.has_truth = truth_.is_open();
        header_.complete = table_.is_complete();
    }

    bool next(TimedAngle& angle) override {
        if (next_row_ == block_.good_rows() && !next_block()) return false;
        const std::size_t i = next_row_++;
        core::AngleRow& r = angle.row;
        r.tick = tick_[i];
        r.dtheta_arcsec = dtheta_arcsec_[i];
        r.dtheta_final_arcsec = dtheta_final_arcsec_[i];
        r.sigma_arcsec = sigma_arcsec_[i];
        r.mode = mode_[i];
        r.flags = flags_[i];
        angle.t_s = t_s_[i];
        angle.truth_dtheta_arcsec = header_.has_truth ? truth_[i] : std::numeric_limits<double>::quiet_NaN();
        return true;
    }

    bool refresh() override {
        const bool grown = table_.refresh();
        header_.complete = table_.is_complete();
        return grown;
    }

    [[nodiscard]] double fraction_read() const override {
        return table_.rows() > 0 ? static_cast<double>(block_end_) / static_cast<double>(table_.rows()) : 0.0;
    }

private:
    void open_columns() {
        table_.open(angles::tick, tick_);
        table_.open(angles::t_s, t_s_);
        table_.open(angles::dtheta_arcsec, dtheta_arcsec_);
        table_.open(angles::dtheta_final_arcsec, dtheta_final_arcsec_);
        table_.open(angles::sigma_arcsec, sigma_arcsec_);
        table_.open(angles::mode, mode_);
        table_.open(angles::flags, flags_);
        if (table_.source().has(angles::truth_path)) {
            truth_ = hdf5::Column<double>{table_.source(), angles::truth_path};
            table_.add(truth_);
        }
        table_.measure();
    }

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

    bool next_block() {
        if (block_.is_damaged()) block_.fail();
        if (block_end_ == table_.rows()) return false;
        next_row_ = 0;
        block_.begin(block_end_, table_.block_size(block_end_));
        try {
            take_columns(static_cast<std::int64_t>(block_end_));
        } catch (...) {
            block_.begin(block_end_, 0);
            throw;
        }
        block_end_ = block_.end();
        if (block_.good_rows() == 0) block_.fail();
        return true;
    }

    void take_columns(std::int64_t first) {
        block_.take(
            tick_, [first](std::int64_t v, std::size_t i) { return v == first + static_cast<std::int64_t>(i); },
            [this, first](std::int64_t v) {
                if (v < 0) return out_of_range(range(0, std::numeric_limits<std::int64_t>::max()));
                return out_of_order(v, first + static_cast<std::int64_t>(block_.good_rows()));
            });
        take_reals(t_s_);
        take_reals(dtheta_arcsec_);
        take_reals(dtheta_final_arcsec_);
        block_.take(
            sigma_arcsec_, [](double v, std::size_t) { return v >= 0.0; },
            [](double v) { return std::string{std::isnan(v) ? not_a_number : sigma_below_zero}; });
        block_.take(
            mode_, [](std::int8_t v, std::size_t) { return (v == 1) | (v == -1); },
            [](std::int64_t) { return out_of_range(allowed_sign); });
        block_.take(
            flags_, [](std::uint32_t, std::size_t) { return true; },
            [](std::int64_t) { return out_of_range(range(0, std::numeric_limits<std::uint32_t>::max())); });
        if (truth_.is_open()) take_reals(truth_);
    }

    void take_reals(hdf5::Column<double>& column) {
        block_.take(
            column, [](double v, std::size_t) { return is_finite(v); }, [](double) { return std::string{not_finite}; });
    }

    hdf5::TableReader table_;
    hdf5::Column<std::int64_t> tick_;
    hdf5::Column<double> t_s_;
    hdf5::Column<double> dtheta_arcsec_;
    hdf5::Column<double> dtheta_final_arcsec_;
    hdf5::Column<double> sigma_arcsec_;
    hdf5::Column<std::int8_t> mode_;
    hdf5::Column<std::uint32_t> flags_;
    hdf5::Column<double> truth_;
    hdf5::Block block_;
    std::size_t next_row_ = 0;  // of the block
    hsize_t block_end_ = 0;     // row behind the block
};

}  // namespace

std::unique_ptr<AngleSource> open_angle_hdf5(const std::string& path) {
    return std::make_unique<AngleHdf5Source>(path);
}

}  // namespace zlg::logs
