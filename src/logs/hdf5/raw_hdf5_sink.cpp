#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <zlg/logs/error.hpp>

#include "hdf5_settings.hpp"
#include "hdf5_table_writer.hpp"
#include "raw_columns.hpp"
#include "raw_log_io.hpp"
#include "raw_timer.hpp"
#include "row_rules.hpp"

namespace zlg::logs {

namespace {

template <class T>
using Rows = std::array<T, hdf5::block_rows>;

// Columns that are not written are filled too, which costs less than to ask for each.
struct RawBlock {
    Rows<std::int64_t> half;
    Rows<std::int64_t> counts;
    Rows<double> detuning_lambda;
    Rows<double> detuning_sq_lambda2;
    Rows<double> piezo_v;
    Rows<double> temperature_c;
    Rows<std::int32_t> edge_offset_ticks;
    Rows<std::int32_t> span;
    Rows<std::int8_t> bias_sign;
    Rows<std::int8_t> mode;
    Rows<std::uint8_t> loop_closed;
    Rows<std::uint8_t> valid;
};

class RawHdf5Sink final : public RawSink {
public:
    RawHdf5Sink(const std::string& path, const Settings& settings, bool force, const RawColumns& columns,
                const RawWriterOptions& options)
        : table_{path, force, options.keep_part},
          columns_{columns},
          light_samples_{static_cast<std::size_t>(options.light_samples)},
          light_(light_samples_ * hdf5::block_rows),
          light_b_(options.light_b ? light_.size() : 0) {
        hdf5::add_settings(table_, settings);
        if (columns_.has_edge_offset) table_.set_real(timer_setting, columns_.timer_hz);
        table_.add_group("/raw");
        add_columns();
        table_.start();
        room_ = table_.room();
    }

    ~RawHdf5Sink() override {
        if (!table_.is_open() || !table_.keeps_part()) return;
        try {
            append();
        } catch (const IoError&) {
            // What was appended before stays readable, and nobody is left to be informed.
        }
    }

    void write(const core::HalfRecord& r, const core::LightSamples& light) override {
        table_.require_open();
        check(r, light);
        const std::size_t i = n_;
        block_->half[i] = r.half;
        block_->counts[i] = r.counts;
        block_->detuning_lambda[i] = r.detuning_lambda;
        block_->detuning_sq_lambda2[i] = r.detuning_sq_lambda2;
        block_->piezo_v[i] = r.piezo_v;
        block_->temperature_c[i] = r.temperature_c;
        block_->edge_offset_ticks[i] = r.edge_offset_ticks;
        block_->span[i] = r.span;
        block_->bias_sign[i] = r.bias_sign;
        block_->mode[i] = r.mode;
        block_->loop_closed[i] = r.loop_closed;
        block_->valid[i] = r.valid;
        if (light_samples_ > 0) std::ranges::copy(light.a, &light_[i * light_samples_]);
        if (!light_b_.empty()) std::ranges::copy(light.b, &light_b_[i * light_samples_]);
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
            const Column& c = raw::hdf5_columns[column];
            if (raw::is_written(columns_, column)) table_.add_column("/raw", {std::string{c.name}, type, c.unit, rows});
        };
        add(raw::half, H5T_NATIVE_INT64, block_->half.data());
        add(raw::bias_sign, H5T_NATIVE_INT8, block_->bias_sign.data());
        add(raw::mode, H5T_NATIVE_INT8, block_->mode.data());
        add(raw::counts, H5T_NATIVE_INT64, block_->counts.data());
        add(raw::loop_closed, H5T_NATIVE_UINT8, block_->loop_closed.data());
        add(raw::valid, H5T_NATIVE_UINT8, block_->valid.data());
        add(raw::detuning_lambda, H5T_NATIVE_DOUBLE, block_->detuning_lambda.data());
        add(raw::detuning_sq_lambda2, H5T_NATIVE_DOUBLE, block_->detuning_sq_lambda2.data());
        add(raw::piezo_v, H5T_NATIVE_DOUBLE, block_->piezo_v.data());
        add(raw::temperature_c, H5T_NATIVE_DOUBLE, block_->temperature_c.data());
        add(raw::edge_offset_ticks, H5T_NATIVE_INT32, block_->edge_offset_ticks.data());
        add(raw::span, H5T_NATIVE_INT32, block_->span.data());
        if (light_samples_ > 0) add_light(raw::light, light_);
        if (!light_b_.empty()) add_light(raw::light_b, light_b_);
    }

    void add_light(std::size_t column, const std::vector<float>& rows) {
        const Column& c = raw::hdf5_columns[column];
        table_.add_column(
            "/raw", {std::string{c.name}, H5T_NATIVE_FLOAT, c.unit, rows.data(), static_cast<int>(light_samples_)});
    }

    void check(const core::HalfRecord& r, const core::LightSamples& light) const {
        require_columns(columns_, r);
        const auto require = [&](bool is_column, double value, std::string_view name) {
            if (is_column && !is_finite(value)) refuse_raw(r, name, value);
        };
        require(columns_.has_detuning, r.detuning_lambda, "detuning_lambda");
        require(columns_.has_detuning_sq, r.detuning_sq_lambda2, "detuning_sq_lambda2");
        require(columns_.has_piezo, r.piezo_v, "piezo_v");
        require(columns_.has_temperature, r.temperature_c, "temperature_c");
        if (light_samples_ > 0) check_light(r, light.a, "light");
        if (!light_b_.empty()) check_light(r, light.b, "light_b");
    }

    void check_light(const core::HalfRecord& r, std::span<const float> light, std::string_view name) const {
        if (light.size() != light_samples_) {
            throw FormatError(fmt::format("half {} cannot be logged: {} samples of {}; allowed are {}", r.half,
                                          light.size(), name, light_samples_));
        }
        for (const float value : light)
            if (!is_finite(value)) refuse_raw(r, name, static_cast<double>(value));
    }

    // Rows that could not be written are lost; a later call fails for the same reason.
    void append() {
        const std::size_t n = std::exchange(n_, 0);
        if (n > 0) table_.append(n);
        room_ = table_.room();
    }

    std::unique_ptr<RawBlock> block_ = std::make_unique<RawBlock>();
    hdf5::TableWriter table_;
    RawColumns columns_;
    std::size_t light_samples_;
    std::vector<float> light_;
    std::vector<float> light_b_;
    std::size_t n_ = 0;     // rows in the block
    std::size_t room_ = 0;  // for so many
};

}  // namespace

std::unique_ptr<RawSink> create_raw_hdf5(const std::string& path, const Settings& settings, bool force,
                                         const RawColumns& columns, const RawWriterOptions& options) {
    return std::make_unique<RawHdf5Sink>(path, settings, force, columns, options);
}

}  // namespace zlg::logs
