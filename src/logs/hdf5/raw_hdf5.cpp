#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>
#include <zlg/logs/error.hpp>

#include "hdf5_settings.hpp"
#include "hdf5_table_sink.hpp"
#include "hdf5_table_source.hpp"
#include "raw_columns.hpp"
#include "raw_log_io.hpp"
#include "raw_timer.hpp"
#include "row_rules.hpp"

namespace zlg::logs {

namespace {

constexpr const char* group = "/raw";
constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

using core::HalfRecord;
constexpr std::tuple fields{
    hdf5::field<std::int64_t>(raw::half, &HalfRecord::half),
    hdf5::field<std::int8_t>(raw::bias_sign, &HalfRecord::bias_sign),
    hdf5::field<std::int8_t>(raw::mode, &HalfRecord::mode),
    hdf5::field<std::int64_t>(raw::counts, &HalfRecord::counts),
    hdf5::field<std::uint8_t>(raw::loop_closed, &HalfRecord::loop_closed),
    hdf5::field<std::uint8_t>(raw::valid, &HalfRecord::valid, 1),
    hdf5::field<double>(raw::detuning_lambda, &HalfRecord::detuning_lambda, not_measured),
    hdf5::field<double>(raw::detuning_sq_lambda2, &HalfRecord::detuning_sq_lambda2, not_measured),
    hdf5::field<double>(raw::piezo_v, &HalfRecord::piezo_v, not_measured),
    hdf5::field<double>(raw::temperature_c, &HalfRecord::temperature_c, not_measured),
    hdf5::field<std::int32_t>(raw::edge_offset_ticks, &HalfRecord::edge_offset_ticks),
    hdf5::field<std::int32_t>(raw::span, &HalfRecord::span, 1),
};

class RawHdf5Sink final : public hdf5::TableSink<RawSink> {
public:
    RawHdf5Sink(const std::string& path, const Settings& settings, bool force, const RawColumns& columns,
                const RawWriterOptions& options)
        : TableSink{path, force, options.keep_part},
          columns_{columns},
          light_samples_{static_cast<std::size_t>(options.light_samples)} {
        hdf5::add_settings(table_, settings);
        if (columns_.has_edge_offset) table_.set_real(timer_setting, columns_.timer_hz);
        table_.add_group(group);
        add_fields(group, raw::hdf5_columns, fields, buffers_,
                   [this](std::size_t column) { return raw::is_written(columns_, column); });
        if (light_samples_ > 0) light_ = add_light(raw::light);
        if (light_samples_ > 0 && options.light_b) light_b_ = add_light(raw::light_b);
        table_.start();
    }

    void write(const HalfRecord& r, const core::LightSamples& light) override {
        table_.require_open();
        check(r, light);
        put(fields, buffers_, r);
        const std::size_t at = table_.row() * light_samples_;
        if (light_ != nullptr) std::ranges::copy(light.a, light_ + at);
        if (light_b_ != nullptr) std::ranges::copy(light.b, light_b_ + at);
        table_.end_row();
    }

private:
    float* add_light(std::size_t column) {
        return table_.add_column<float>(group, raw::hdf5_columns[column], static_cast<int>(light_samples_));
    }

    void check(const HalfRecord& r, const core::LightSamples& light) const {
        require_columns(columns_, r);
        for_each_field(fields, buffers_, [&]<class T>(const auto& field, T*) {
            if constexpr (std::is_same_v<T, double>) {
                const double value = r.*field.member;
                if (!is_finite(value) && raw::is_written(columns_, field.column))
                    refuse_raw(r, raw::hdf5_columns[field.column].name, value);
            }
        });
        if (light_ != nullptr) check_light(r, light.a, "light");
        if (light_b_ != nullptr) check_light(r, light.b, "light_b");
    }

    void check_light(const HalfRecord& r, std::span<const float> light, std::string_view name) const {
        if (light.size() != light_samples_) {
            throw FormatError(fmt::format("half {} cannot be logged: {} samples of {}; allowed are {}", r.half,
                                          light.size(), name, light_samples_));
        }
        for (const float value : light)
            if (!is_finite(value)) refuse_raw(r, name, static_cast<double>(value));
    }

    RawColumns columns_;
    std::size_t light_samples_;
    decltype(hdf5::parts_of<hdf5::Buffer>(fields)) buffers_{};
    float* light_ = nullptr;
    float* light_b_ = nullptr;
};

class RawHdf5Source final : public hdf5::TableSource<RawSource> {
public:
    explicit RawHdf5Source(const std::string& path) : TableSource{path, group, raw::hdf5_columns} {
        open_fields(fields, columns_);
        table_.open(raw::light, light_, core::max_light_samples);
        table_.open(raw::light_b, light_b_, core::max_light_samples);
        table_.measure();
        header_.settings = hdf5::read_settings(table_.source());
        header_.warnings = table_.warnings();
        raw::note_columns(table_, header_);
        if (header_.has_edge_offset) {
            header_.timer_hz = take_timer_hz(header_.settings, table_.source().real_attribute(timer_setting), path);
        }
        header_.light_samples = table_.has(raw::light) ? static_cast<int>(light_.width()) : 0;
        header_.has_light_b = table_.has(raw::light_b);
        require_matching_beams(path);
        header_.complete = table_.is_complete();
    }

    bool next(HalfRecord& r) override { return next_row(fields, columns_, r); }

    [[nodiscard]] core::LightSamples light() const override {
        if (n_handed_out_ == 0) return {};
        return {samples_of(light_), samples_of(light_b_)};
    }

private:
    // Of the row that was read last.
    [[nodiscard]] std::span<const float> samples_of(const hdf5::Column<float>& beam) const {
        if (!beam.is_open()) return {};
        return {beam.values() + (n_handed_out_ - 1) * beam.width(), beam.width()};
    }

    void require_matching_beams(const std::string& path) const {
        if (!header_.has_light_b || static_cast<int>(light_b_.width()) == header_.light_samples) return;
        throw FormatError(fmt::format("{}: /raw/light_b has {} samples in a half; allowed are the {} of /raw/light",
                                      path, light_b_.width(), header_.light_samples));
    }

    void take_columns(std::int64_t first) override {
        take_indices(std::get<raw::half>(columns_), first);
        take_bias_signs(first);
        take_signs(std::get<raw::mode>(columns_));
        block_.take(
            std::get<raw::counts>(columns_),
            [](std::int64_t v, std::size_t) { return (v >= -max_counts) & (v <= max_counts); },
            [](std::int64_t) { return out_of_range(range(-max_counts, max_counts)); });
        take_flags(std::get<raw::loop_closed>(columns_));
        take_flags(std::get<raw::valid>(columns_));
        take_detunings();
        take_reals(std::get<raw::piezo_v>(columns_));
        take_reals(std::get<raw::temperature_c>(columns_));
        take_reals(light_);
        take_reals(light_b_);
        take_integers(std::get<raw::edge_offset_ticks>(columns_));
        take_integers(std::get<raw::span>(columns_), 1);
        if (header_.has_span) check_spans();
    }

    // Of two neighbours one is +1 and the other -1: with the first one known, all are.
    void take_bias_signs(std::int64_t first) {
        auto& signs = std::get<raw::bias_sign>(columns_);
        block_.take(
            signs,
            [&signs, this, first](std::int8_t v, std::size_t i) {
                const int of_even = first_bias_sign_ != 0 ? first_bias_sign_ : signs[0];
                const bool is_odd = ((static_cast<std::size_t>(first) + i) & 1u) != 0;
                return ((v == 1) | (v == -1)) & (v == (is_odd ? -of_even : of_even));
            },
            [](std::int64_t v) { return v == 1 || v == -1 ? not_alternating(v) : out_of_range(allowed_sign); });
        if (first == 0 && block_.good_rows() > 0) first_bias_sign_ = signs[0];
    }

    void take_flags(hdf5::Column<std::uint8_t>& column) {
        if (!column.is_open()) return;
        block_.take(
            column, [](std::uint8_t v, std::size_t) { return v <= 1; },
            [](std::int64_t) { return out_of_range(allowed_flag); });
    }

    void take_detunings() {
        auto& means = std::get<raw::detuning_lambda>(columns_);
        auto& squares = std::get<raw::detuning_sq_lambda2>(columns_);
        if (means.is_open())
            block_.take(
                means, [](double v, std::size_t) { return is_detuning(v); }, no_detuning);
        if (!squares.is_open()) return;
        const auto mean = [&means](std::size_t i) { return means.is_open() ? means[i] : not_measured; };
        block_.take(
            squares, [mean](double v, std::size_t i) { return is_detuning_sq(v, mean(i)); },
            [this, mean](double v) { return no_detuning_sq(v, mean(block_.good_rows())); });
    }

    // Row by row, for what is allowed depends on those before.
    void check_spans() {
        const auto& valid = std::get<raw::valid>(columns_);
        const auto& counts = std::get<raw::counts>(columns_);
        auto& spans = std::get<raw::span>(columns_);
        std::size_t good = 0;
        for (; good < block_.good_rows() && missed_.allows(spans[good]); ++good)
            missed_.add(!header_.has_valid || valid[good] != 0, counts[good], spans[good]);
        if (good == block_.good_rows()) return;
        block_.take(
            spans, [good](std::int32_t, std::size_t i) { return i < good; },
            [this](std::int64_t) { return beyond_missed(missed_); });
    }

    decltype(hdf5::parts_of<hdf5::Column>(fields)) columns_;
    hdf5::Column<float> light_;
    hdf5::Column<float> light_b_;
    MissedRows missed_;
    std::int8_t first_bias_sign_ = 0;
};

}  // namespace

std::unique_ptr<RawSource> open_raw_hdf5(const std::string& path) { return std::make_unique<RawHdf5Source>(path); }

std::unique_ptr<RawSink> create_raw_hdf5(const std::string& path, const Settings& settings, bool force,
                                         const RawColumns& columns, const RawWriterOptions& options) {
    return std::make_unique<RawHdf5Sink>(path, settings, force, columns, options);
}

}  // namespace zlg::logs
