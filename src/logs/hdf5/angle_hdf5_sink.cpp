#include <fmt/format.h>

#include <array>
#include <zlg/logs/error.hpp>

#include "angle_columns.hpp"
#include "angle_log_io.hpp"
#include "hdf5_settings.hpp"
#include "hdf5_table_writer.hpp"
#include "row_rules.hpp"
#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

template <class T>
using Rows = std::array<T, hdf5::block_rows>;

struct AngleBlock {
    Rows<std::int64_t> tick;
    Rows<double> t_s;
    Rows<double> dtheta_arcsec;
    Rows<double> dtheta_final_arcsec;
    Rows<double> sigma_arcsec;
    Rows<double> truth_dtheta_arcsec;
    Rows<std::uint32_t> flags;
    Rows<std::int8_t> mode;
};

class AngleHdf5Sink final : public AngleSink {
public:
    AngleHdf5Sink(const std::string& path, double tick_s, const Settings& settings, bool force,
                  const AngleWriterOptions& options)
        : table_{path, force, options.keep_part}, has_truth_{options.has_truth} {
        hdf5::add_angle_settings(table_, settings, tick_s);
        table_.add_group("/angles");
        add_columns();
        const std::string* legend = find_setting(settings, "flags");
        table_.set_text("/angles/flags", "flags", legend != nullptr ? *legend : angles::flag_legend());
        table_.start();
        room_ = table_.room();
    }

    ~AngleHdf5Sink() override {
        if (!table_.is_open() || !table_.keeps_part()) return;
        try {
            append();
        } catch (const IoError&) {
            // What was appended before stays readable, and nobody is left to be informed.
        }
    }

    void write(const TimedAngle& angle) override {
        table_.require_open();
        angles::require_loggable(angle);
        if (has_truth_ && !is_finite(angle.truth_dtheta_arcsec)) refuse_truth(angle);
        const std::size_t i = n_;
        block_->tick[i] = angle.row.tick;
        block_->t_s[i] = angle.t_s;
        block_->dtheta_arcsec[i] = angle.row.dtheta_arcsec;
        block_->dtheta_final_arcsec[i] = angle.row.dtheta_final_arcsec;
        block_->sigma_arcsec[i] = angle.row.sigma_arcsec;
        block_->truth_dtheta_arcsec[i] = angle.truth_dtheta_arcsec;
        block_->flags[i] = angle.row.flags;
        block_->mode[i] = angle.row.mode;
        if (++n_ == room_) append();
    }

    void flush() override {
        table_.require_open();
        append();
    }

    void close() override {
        table_.require_open();
        append();
        table_.close();
    }

    [[nodiscard]] const std::string& part_path() const override { return table_.part_path(); }

private:
    void add_columns() {
        const auto add = [this](std::size_t column, hid_t type, const void* rows) {
            const Column& c = angles::columns[column];
            table_.add_column("/angles", {std::string{c.name}, type, c.unit, rows});
        };
        add(angles::tick, H5T_NATIVE_INT64, block_->tick.data());
        add(angles::t_s, H5T_NATIVE_DOUBLE, block_->t_s.data());
        add(angles::dtheta_arcsec, H5T_NATIVE_DOUBLE, block_->dtheta_arcsec.data());
        add(angles::dtheta_final_arcsec, H5T_NATIVE_DOUBLE, block_->dtheta_final_arcsec.data());
        add(angles::sigma_arcsec, H5T_NATIVE_DOUBLE, block_->sigma_arcsec.data());
        add(angles::mode, H5T_NATIVE_INT8, block_->mode.data());
        add(angles::flags, H5T_NATIVE_UINT32, block_->flags.data());
        if (!has_truth_) return;
        table_.add_group(angles::truth_group);
        table_.add_column(angles::truth_group,
                          {angles::truth_name, H5T_NATIVE_DOUBLE, "arcsec", block_->truth_dtheta_arcsec.data()});
    }

    [[noreturn]] static void refuse_truth(const TimedAngle& angle) {
        throw FormatError(fmt::format("tick {} cannot be logged: true dtheta is {}; allowed is a finite number",
                                      angle.row.tick, angle.truth_dtheta_arcsec));
    }

    // Rows that could not be written are lost; a later call fails for the same reason.
    void append() {
        const std::size_t n = std::exchange(n_, 0);
        if (n > 0) table_.append(n);
        room_ = table_.room();
    }

    std::unique_ptr<AngleBlock> block_ = std::make_unique<AngleBlock>();
    hdf5::TableWriter table_;
    bool has_truth_;
    std::size_t n_ = 0;     // rows in the block
    std::size_t room_ = 0;  // for so many
};

}  // namespace

std::unique_ptr<AngleSink> create_angle_hdf5(const std::string& path, double tick_s, const Settings& settings,
                                             bool force, const AngleWriterOptions& options) {
    return std::make_unique<AngleHdf5Sink>(path, tick_s, settings, force, options);
}

}  // namespace zlg::logs
