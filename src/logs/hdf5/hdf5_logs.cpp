// Both logs as HDF5: the columns of their tables, what stands in an HDF5 log besides, and the settings: /config and the
// attributes of the root.

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>

#include "hdf5_table_source.hpp"
#include "hdf5_table_writer.hpp"
#include "settings_lines.hpp"
#include "toml_settings.hpp"

namespace zlg::logs {
namespace {

// What a reader must know to make angles of counts stands in the root, too.
constexpr std::array<const char*, 2> root_reals{"tick_s", "scale_arcsec"};

void merge_root(const hdf5::Source& source, const char* name, bool adds, Settings& settings) {
    const auto value = source.real_attribute(name);
    if (!value) return;
    const std::string* text = find_of_gyro(settings, name);
    if (text == nullptr) {
        if (adds) settings.emplace_back(fmt::format("gyro.{}", name), fmt::format("{}", *value));
        return;
    }
    const auto configured = number_in(*text);
    if (configured && *configured == *value) return;
    throw FormatError(fmt::format("{}: the attribute {} is {}, but /config says {}; allowed is one value",
                                  source.path(), name, *value, *text));
}

// Writes /config and format_version, and of the settings tick_s and scale_arcsec, with or without `gyro.`, the
// attributes of that name. A given tick_s goes before the settings' own.
//
// errors  FormatError: a setting that is no text of one line; IoError.
void add_settings(hdf5::TableWriter& table, const Settings& settings, const FormatVersion& version,
                  std::optional<double> tick_s = std::nullopt) {
    table.add_text("/config", settings_to_toml(settings));
    if (version) table.set_integer(version_setting, *version);
    for (const char* name : root_reals) {
        if (tick_s && name == std::string_view{"tick_s"}) {
            table.set_real(name, *tick_s);
        } else if (const std::string* text = find_of_gyro(settings, name)) {
            if (const auto value = number_in(*text)) table.set_real(name, *value);
        }
    }
}

// The same for an angle log: the settings `flags` and `tick_s` have attributes of their own and no line in /config.
void add_angle_settings(hdf5::TableWriter& table, Settings settings, const FormatVersion& version) {
    std::optional<double> tick_s;
    if (const std::string* text = find_setting(settings, "tick_s")) {
        tick_s = number_in(*text);
        if (!tick_s) throw FormatError(fmt::format("the setting tick_s is '{}'; allowed is a number", *text));
    }
    std::erase_if(settings, [](const auto& setting) { return setting.first == "flags" || setting.first == "tick_s"; });
    add_settings(table, settings, version, tick_s);
}

FormatVersion read_format_version(const hdf5::Source& source) {
    const auto version = source.real_attribute(version_setting);
    if (!version) return std::nullopt;
    return checked_format_version(*version, source.path());
}

// Reads /config; attributes of the root stand for settings that /config lacks. With `adds_tick` false, tick_s is only
// compared with /config.
//
// errors  FormatError: no TOML, an attribute that is no number or contradicts /config.
Settings read_settings(const hdf5::Source& source, bool adds_tick = true) {
    Settings settings;
    if (const auto text = source.text("/config")) settings = settings_from_toml(*text, source.path() + ", /config");
    require_shallow_keys(settings, source.path() + ", /config");
    // What a zlg before format_version 2 of CSV logs took for notes; the attributes say it.
    std::erase_if(settings, [](const auto& setting) {
        return setting.first == version_setting || setting.first == "fingerprint";
    });
    for (const char* name : root_reals) {
        merge_root(source, name, adds_tick || name != std::string_view{"tick_s"}, settings);
    }
    return settings;
}

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
        add_settings(table_, settings, options.format_version);
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
        header_.format_version = read_format_version(source_);
        header_.settings = read_settings(source_);
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

// What the twin turned in each tick.
constexpr const char* truth_group = "/truth";
constexpr const char* truth_name = "dtheta_arcsec";
constexpr const char* truth_path = "/truth/dtheta_arcsec";

class AngleHdf5Sink final : public hdf5::TableSink<AngleTable> {
public:
    AngleHdf5Sink(const std::string& path, bool force, const Settings& settings, const AngleWriterOptions& options)
        : TableSink{path, force, options, {}} {
        add_angle_settings(table_, settings, options.format_version);
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
        header_.format_version = read_format_version(source_);
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
        Settings settings = read_settings(source_, false);
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

std::unique_ptr<LogSource<RawTable>> open_raw_hdf5(const std::string& path) {
    return std::make_unique<RawHdf5Source>(path);
}

std::unique_ptr<LogSink<RawTable>> create_raw_hdf5(const std::string& path, bool force, const Settings& settings,
                                                   const RawColumns& columns, const RawWriterOptions& options) {
    return std::make_unique<RawHdf5Sink>(path, force, settings, columns, options);
}

std::unique_ptr<LogSource<AngleTable>> open_angle_hdf5(const std::string& path) {
    return std::make_unique<AngleHdf5Source>(path);
}

std::unique_ptr<LogSink<AngleTable>> create_angle_hdf5(const std::string& path, bool force, const Settings& settings,
                                                       const AngleWriterOptions& options) {
    return std::make_unique<AngleHdf5Sink>(path, force, settings, options);
}

}  // namespace zlg::logs
