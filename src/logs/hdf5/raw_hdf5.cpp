#include <fmt/format.h>

#include <algorithm>
#include <zlg/logs/error.hpp>

#include "hdf5_settings.hpp"
#include "hdf5_table_sink.hpp"
#include "hdf5_table_source.hpp"
#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

// Beside the columns of RawTable: the light samples of both beams, halves x N.
constexpr std::size_t light = n_columns<RawTable>;
constexpr std::size_t light_b = light + 1;

constexpr auto all_columns = [] {
    std::array<KnownColumn, light_b + 1> columns;
    std::ranges::copy(known_columns<RawTable>, columns.begin());
    columns[light] = {"light", false};
    columns[light_b] = {"light_b", false};
    return columns;
}();

class RawHdf5Sink final : public hdf5::TableSink<RawTable> {
public:
    RawHdf5Sink(const std::string& path, bool force, const Settings& settings, const RawColumns& columns,
                const RawWriterOptions& options)
        : TableSink{path, force, options, columns}, light_samples_{static_cast<std::size_t>(options.light_samples)} {
        hdf5::add_settings(table_, settings, options.format_version);
        if (columns.has_edge_offset) table_.set_real(timer_setting, columns.timer_hz);
        add_columns();
        if (light_samples_ > 0) light_ = add_light("light");
        if (light_samples_ > 0 && options.light_b) light_b_ = add_light("light_b");
        table_.start();
    }

    void write(const core::HalfRecord& r, const core::LightSamples& samples) override {
        require_loggable(r);
        if (light_ != nullptr) check_light(r, samples.a, "light");
        if (light_b_ != nullptr) check_light(r, samples.b, "light_b");
        put(r);
        const std::size_t at = table_.row() * light_samples_;
        if (light_ != nullptr) std::ranges::copy(samples.a, light_ + at);
        if (light_b_ != nullptr) std::ranges::copy(samples.b, light_b_ + at);
        table_.end_row();
    }

private:
    float* add_light(const char* name) { return table_.add_column<float>(RawTable::group, name, "1", light_samples_); }

    void check_light(const core::HalfRecord& r, std::span<const float> samples, std::string_view name) const {
        if (samples.size() != light_samples_) {
            throw FormatError(fmt::format("half {} cannot be logged: {} samples of {}; allowed are {}", r.half,
                                          samples.size(), name, light_samples_));
        }
        for (const float value : samples)
            if (!Sample::allows(value, r.half))
                throw FormatError(fmt::format("half {} cannot be logged: {} is {}; allowed is {}", r.half, name, value,
                                              Sample::allowed()));
    }

    std::size_t light_samples_;
    float* light_ = nullptr;
    float* light_b_ = nullptr;
};

class RawHdf5Source final : public hdf5::TableSource<RawTable> {
public:
    explicit RawHdf5Source(const std::string& path) : TableSource{path, all_columns} {
        open(logs::light, "light", light_, core::max_light_samples);
        open(logs::light_b, "light_b", light_b_, core::max_light_samples);
        measure();
        header_.format_version = hdf5::read_format_version(source_);
        header_.settings = hdf5::read_settings(source_);
        note_columns(*this, header_);
        if (header_.has_edge_offset)
            header_.timer_hz = take_timer_hz(header_.settings, source_.real_attribute(timer_setting), path);
        header_.light_samples = light_.is_open() ? static_cast<int>(light_.width()) : 0;
        header_.has_light_b = light_b_.is_open();
        require_matching_beams(path);
    }

    [[nodiscard]] core::LightSamples light() const override { return {samples_of(light_), samples_of(light_b_)}; }

private:
    // Of the row that was read last.
    [[nodiscard]] std::span<const float> samples_of(const hdf5::Column<float>& beam) const {
        if (!beam.is_open() || last_row() < 0) return {};
        return {beam.values() + static_cast<std::size_t>(last_row()) * beam.width(), beam.width()};
    }

    void require_matching_beams(const std::string& path) const {
        if (!header_.has_light_b || static_cast<int>(light_b_.width()) == header_.light_samples) return;
        throw FormatError(fmt::format("{}: /raw/light_b has {} samples in a half; allowed are the {} of /raw/light",
                                      path, light_b_.width(), header_.light_samples));
    }

    void take_others(hdf5::Block& block) override {
        block.take(light_, Sample{});
        block.take(light_b_, Sample{});
    }

    hdf5::Column<float> light_;
    hdf5::Column<float> light_b_;
};

}  // namespace

std::unique_ptr<LogSource<RawTable>> open_raw_hdf5(const std::string& path) {
    return std::make_unique<RawHdf5Source>(path);
}

std::unique_ptr<LogSink<RawTable>> create_raw_hdf5(const std::string& path, bool force, const Settings& settings,
                                                   const RawColumns& columns, const RawWriterOptions& options) {
    return std::make_unique<RawHdf5Sink>(path, force, settings, columns, options);
}

}  // namespace zlg::logs
