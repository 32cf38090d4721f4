#include <fmt/format.h>

#include <limits>
#include <zlg/logs/error.hpp>

#include "hdf5_settings.hpp"
#include "hdf5_table_reader.hpp"
#include "raw_columns.hpp"
#include "raw_log_io.hpp"
#include "raw_timer.hpp"
#include "row_rules.hpp"

namespace zlg::logs {

namespace {

class RawHdf5Source final : public RawSource {
public:
    explicit RawHdf5Source(const std::string& path) : table_{path, "/raw", raw::hdf5_columns}, block_{table_.source()} {
        open_columns();
        header_.settings = hdf5::read_settings(table_.source());
        header_.warnings = table_.warnings();
        header_.has_valid = table_.has(raw::valid);
        header_.has_detuning = table_.has(raw::detuning_lambda);
        header_.has_detuning_sq = table_.has(raw::detuning_sq_lambda2);
        header_.has_piezo = table_.has(raw::piezo_v);
        header_.has_temperature = table_.has(raw::temperature_c);
        header_.has_edge_offset = table_.has(raw::edge_offset_ticks);
        header_.has_span = table_.has(raw::span);
        if (header_.has_edge_offset) {
            header_.timer_hz = take_timer_hz(header_.settings, table_.source().real_attribute(timer_setting), path);
        }
        header_.light_samples = table_.has(raw::light) ? static_cast<int>(light_.width()) : 0;
        header_.has_light_b = table_.has(raw::light_b);
        require_matching_beams(path);
        header_.complete = table_.is_complete();
    }

    bool next(core::HalfRecord& r) override {
        if (next_row_ == block_.good_rows() && !next_block()) return false;
        const std::size_t i = next_row_++;
        r.half = half_[i];
        r.bias_sign = bias_sign_[i];
        r.mode = mode_[i];
        r.counts = counts_[i];
        r.loop_closed = loop_closed_[i] != 0;
        r.valid = !header_.has_valid || valid_[i] != 0;
        r.detuning_lambda = header_.has_detuning ? detuning_lambda_[i] : absent;
        r.detuning_sq_lambda2 = header_.has_detuning_sq ? detuning_sq_lambda2_[i] : absent;
        r.piezo_v = header_.has_piezo ? piezo_v_[i] : absent;
        r.temperature_c = header_.has_temperature ? temperature_c_[i] : absent;
        r.edge_offset_ticks = header_.has_edge_offset ? edge_offset_ticks_[i] : 0;
        r.span = header_.has_span ? span_[i] : 1;
        return true;
    }

    bool refresh() override {
        const bool grown = table_.refresh();
        header_.complete = table_.is_complete();
        return grown;
    }

    [[nodiscard]] core::LightSamples light() const override {
        if (next_row_ == 0) return {};
        return {samples_of(light_), samples_of(light_b_)};
    }

    [[nodiscard]] double fraction_read() const override {
        return table_.rows() > 0 ? static_cast<double>(block_end_) / static_cast<double>(table_.rows()) : 0.0;
    }

private:
    static constexpr double absent = std::numeric_limits<double>::quiet_NaN();

    // Of the row that was read last.
    [[nodiscard]] std::span<const float> samples_of(const hdf5::Column<float>& beam) const {
        if (!beam.is_open()) return {};
        return {beam.values() + (next_row_ - 1) * beam.width(), beam.width()};
    }

    void require_matching_beams(const std::string& path) const {
        if (!header_.has_light_b || static_cast<int>(light_b_.width()) == header_.light_samples) return;
        throw FormatError(fmt::format("{}: /raw/light_b has {} samples in a half; allowed are the {} of /raw/light",
                                      path, light_b_.width(), header_.light_samples));
    }

    void open_columns() {
        table_.open(raw::half, half_);
        table_.open(raw::bias_sign, bias_sign_);
        table_.open(raw::mode, mode_);
        table_.open(raw::counts, counts_);
        table_.open(raw::loop_closed, loop_closed_);
        table_.open(raw::valid, valid_);
        table_.open(raw::detuning_lambda, detuning_lambda_);
        table_.open(raw::detuning_sq_lambda2, detuning_sq_lambda2_);
        table_.open(raw::piezo_v, piezo_v_);
        table_.open(raw::temperature_c, temperature_c_);
        table_.open(raw::edge_offset_ticks, edge_offset_ticks_);
        table_.open(raw::span, span_);
        table_.open(raw::light, light_, core::max_light_samples);
        table_.open(raw::light_b, light_b_, core::max_light_samples);
        table_.measure();
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
        take_indices(first);
        const auto is_sign = [](std::int8_t v, std::size_t) { return (v == 1) | (v == -1); };
        const auto is_flag = [](std::uint8_t v, std::size_t) { return v <= 1; };
        const auto no_sign = [](std::int64_t) { return out_of_range(allowed_sign); };
        const auto no_flag = [](std::int64_t) { return out_of_range(allowed_flag); };
        block_.take(mode_, is_sign, no_sign);
        block_.take(
            counts_, [](std::int64_t v, std::size_t) { return (v >= -max_counts) & (v <= max_counts); },
            [](std::int64_t) { return out_of_range(range(-max_counts, max_counts)); });
        block_.take(loop_closed_, is_flag, no_flag);
        if (valid_.is_open()) block_.take(valid_, is_flag, no_flag);
        take_detunings();
        for (auto* reals : {&piezo_v_, &temperature_c_}) take_reals(*reals);
        take_reals(light_);
        take_reals(light_b_);
        using Limits = std::numeric_limits<std::int32_t>;
        const auto any = [](std::int32_t, std::size_t) { return true; };
        if (edge_offset_ticks_.is_open())
            block_.take(edge_offset_ticks_, any,
                        [](std::int64_t) { return out_of_range(range(Limits::min(), Limits::max())); });
        if (!span_.is_open()) return;
        block_.take(span_, any, [](std::int64_t) { return out_of_range(range(1, Limits::max())); });
        check_spans();
    }

    void take_detunings() {
        if (detuning_lambda_.is_open())
            block_.take(
                detuning_lambda_, [](double v, std::size_t) { return is_detuning(v); }, no_detuning);
        if (!detuning_sq_lambda2_.is_open()) return;
        const auto mean = [this](std::size_t i) { return detuning_lambda_.is_open() ? detuning_lambda_[i] : absent; };
        block_.take(
            detuning_sq_lambda2_, [mean](double v, std::size_t i) { return is_detuning_sq(v, mean(i)); },
            [this, mean](double v) { return no_detuning_sq(v, mean(block_.good_rows())); });
    }

    // Row by row, for what is allowed depends on those before.
    void check_spans() {
        std::size_t good = 0;
        for (; good < block_.good_rows() && missed_.allows(span_[good]); ++good)
            missed_.add(!header_.has_valid || valid_[good] != 0, counts_[good], span_[good]);
        if (good == block_.good_rows()) return;
        block_.take(
            span_, [good](std::int32_t, std::size_t i) { return i < good; },
            [this](std::int64_t) { return beyond_missed(missed_); });
    }

    void take_indices(std::int64_t first) {
        block_.take(
            half_, [first](std::int64_t v, std::size_t i) { return v == first + static_cast<std::int64_t>(i); },
            [this, first](std::int64_t v) {
                if (v < 0) return out_of_range(range(0, std::numeric_limits<std::int64_t>::max()));
                return out_of_order(v, first + static_cast<std::int64_t>(block_.good_rows()));
            });
        // Of two neighbours one is +1 and the other -1: with the first one known, all are.
        block_.take(
            bias_sign_,
            [this, first](std::int8_t v, std::size_t i) {
                const int of_even = first_bias_sign_ != 0 ? first_bias_sign_ : bias_sign_[0];
                const bool is_odd = ((static_cast<std::size_t>(first) + i) & 1u) != 0;
                return ((v == 1) | (v == -1)) & (v == (is_odd ? -of_even : of_even));
            },
            [](std::int64_t v) { return v == 1 || v == -1 ? not_alternating(v) : out_of_range(allowed_sign); });
        if (first == 0 && block_.good_rows() > 0) first_bias_sign_ = bias_sign_[0];
    }

    template <class T>
    void take_reals(hdf5::Column<T>& column) {
        if (!column.is_open()) return;
        block_.take(
            column, [](T v, std::size_t) { return is_finite(v); }, [](T) { return std::string{not_finite}; });
    }

    hdf5::TableReader table_;
    hdf5::Column<std::int64_t> half_;
    hdf5::Column<std::int8_t> bias_sign_;
    hdf5::Column<std::int8_t> mode_;
    hdf5::Column<std::int64_t> counts_;
    hdf5::Column<std::uint8_t> loop_closed_;
    hdf5::Column<std::uint8_t> valid_;
    hdf5::Column<double> detuning_lambda_;
    hdf5::Column<double> detuning_sq_lambda2_;
    hdf5::Column<double> piezo_v_;
    hdf5::Column<double> temperature_c_;
    hdf5::Column<std::int32_t> edge_offset_ticks_;
    hdf5::Column<std::int32_t> span_;
    MissedRows missed_;
    hdf5::Column<float> light_;
    hdf5::Column<float> light_b_;
    hdf5::Block block_;
    std::size_t next_row_ = 0;  // of the block
    hsize_t block_end_ = 0;     // row behind the block
    std::int8_t first_bias_sign_ = 0;
};

}  // namespace

std::unique_ptr<RawSource> open_raw_hdf5(const std::string& path) { return std::make_unique<RawHdf5Source>(path); }

}  // namespace zlg::logs
