#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <zlg/calibration/lab_reader.hpp>
#include <zlg/config/log_settings.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/recorded/environment.hpp>
#include <zlg/recorded/log_compensation.hpp>
#include <zlg/rig/bias_check.hpp>
#include <zlg/study/calibrate.hpp>
#include <zlg/twin/environment.hpp>

namespace zlg::study {
namespace {

constexpr std::string_view bias_coefficient = "gyro.bias_temperature_coefficient_per_c";
constexpr double max_rate_arcsec_s = 1e9;

struct Lab {
    std::vector<calibration::LabLog> logs;
    std::vector<config::Config> configs;   // of each log, with what the user says over it
    std::vector<config::Config> recorded;  // how its detunings were read
    std::vector<rig::BiasCheck> signs;     // whether its columns mode and bias_sign belong to its counts
    std::vector<std::string> warnings;
};

void check(const CalibrationTask& task) {
    if (!(std::abs(task.rate_arcsec_s) <= max_rate_arcsec_s))
        throw config::ConfigError{
            fmt::format("{} {}: allowed is -1e9..1e9, more than any gyro turns", task.rate_name, task.rate_arcsec_s)};
    std::error_code ignored;
    for (std::size_t k = 1; k < task.logs.size(); ++k)
        for (std::size_t j = 0; j < k; ++j)
            if (std::filesystem::equivalent(task.logs[j], task.logs[k], ignored))
                throw config::ConfigError{fmt::format("{}: is named twice; each log counts once", task.logs[k])};
}

calibration::LabLog read(logs::RawReader& raw, const std::string& path, double tick_s, rig::BiasCheck& signs,
                         const std::function<void(double)>& on_progress) {
    calibration::LabReader reader{path, tick_s};
    core::HalfRecord record;
    std::int64_t halves = 0;
    while (raw.next(record)) {
        reader.take(record);
        signs.take(record);
        if (++halves % 100'000 == 0 && on_progress) on_progress(raw.fraction_read());
    }
    if (halves < 2) throw logs::FormatError{fmt::format("{}: holds no whole tick, which is two half-periods", path)};
    return reader.finish();
}

Lab read_all(const CalibrationTask& task) {
    Lab lab;
    const auto n_logs = static_cast<double>(task.logs.size());
    for (std::size_t k = 0; k < task.logs.size(); ++k) {
        const std::string& path = task.logs[k];
        logs::RawReader raw = task.open(path);
        const logs::RawHeader& header = raw.header();
        lab.warnings.insert(lab.warnings.end(), header.warnings.begin(), header.warnings.end());
        if (const auto note = config::former_keys_note(header.settings, path)) lab.warnings.push_back(*note);
        if (header.has_edge_offset)
            lab.warnings.push_back(
                fmt::format("{}: the shifts of the bias edges are left in its counts, as noise", path));
        lab.configs.push_back(recorded::config_of_log(task.said, header.settings, path));
        lab.recorded.push_back(recorded::as_recorded(lab.configs.back(), header.settings, path));
        const auto notify = [&](double of_log) {
            if (task.on_progress) task.on_progress((static_cast<double>(k) + of_log) / n_logs);
        };
        const config::Gyro& gyro = lab.configs.back().gyro;
        lab.signs.emplace_back(
            core::CompensationConstants{.tick = core::Seconds{gyro.tick_s}, .bias = core::Hertz{gyro.bias_hz}});
        lab.logs.push_back(read(raw, path, gyro.tick_s, lab.signs.back(), notify));
        if (!raw.line_is_ended())
            lab.warnings.push_back(fmt::format("{}: the last line has no end; the file may have been cut off", path));
    }
    return lab;
}

// Logs of one gyro, counted alike.
void check_agreement(const CalibrationTask& task, const Lab& lab) {
    const config::Gyro& first = lab.configs.front().gyro;
    for (std::size_t k = 1; k < lab.configs.size(); ++k) {
        const config::Gyro& gyro = lab.configs[k].gyro;
        const auto differ = [&](const char* key, double a, double b) {
            return fmt::format("{} = {} in {}, {} in {}", key, a, task.logs.front(), b, task.logs[k]);
        };
        if (gyro.tick_s != first.tick_s)
            throw logs::FormatError{differ("gyro.tick_s", first.tick_s, gyro.tick_s) + "; allowed is one value"};
        if (gyro.scale_arcsec != first.scale_arcsec)
            throw logs::FormatError{differ("gyro.scale_arcsec", first.scale_arcsec, gyro.scale_arcsec) +
                                    "; allowed is one value"};
        if (gyro.reference_temperature_c != first.reference_temperature_c)
            throw config::ConfigError{
                differ("gyro.reference_temperature_c", first.reference_temperature_c, gyro.reference_temperature_c) +
                "; say in the configuration (--set) to which temperature the constants are to refer"};
        if (lab.configs[k].perimeter.loop != lab.configs.front().perimeter.loop)
            throw config::ConfigError{fmt::format("perimeter.loop differs between {} and {}; calibrate them apart",
                                                  task.logs.front(), task.logs[k])};
    }
}

bool read_by_one_slope(const Lab& lab) {
    return std::ranges::all_of(lab.recorded, [&lab](const config::Config& c) {
        return c.perimeter.discriminator_signal.empty() &&
               c.gyro.discriminator_per_lambda == lab.recorded.front().gyro.discriminator_per_lambda;
    });
}

// Of each log, as its head or the user says; none where one of them does not. Whether a file that a log names is still
// the same nobody knows.
calibration::KnownFields fields_of(const CalibrationTask& task, const Lab& lab) {
    calibration::KnownFields known;
    for (const config::Config& c : lab.configs) {
        const bool is_unseen = c.field.kind == config::FieldKind::file && !config::is_given(task.said, "field.course");
        if (c.field.kind == config::FieldKind::none || is_unseen) return {};
        if (c.field.kind == config::FieldKind::sine && c.field.frequency_hz > calibration::fastest_field_hz)
            return {.why_none = fmt::format("field.frequency_hz = {:g} tells nothing: allowed is up to {:g} Hz",
                                            c.field.frequency_hz, calibration::fastest_field_hz)};
        config::Config only;
        only.field = c.field;
        known.of_logs.emplace_back(
            [field = recorded::with_environment(only).field](double time_s) { return twin::field_g(field, time_s); });
    }
    return known;
}

// Of what is to be found, only what the user says is presumed, never what a log says of itself.
calibration::Presumed presumed(const CalibrationTask& task, const Lab& lab) {
    const config::Config& of_logs = lab.configs.front();
    return {.scale_arcsec = of_logs.gyro.scale_arcsec,
            .reference_temperature_c = of_logs.gyro.reference_temperature_c,
            .rate_arcsec_s = task.rate_arcsec_s,
            .read_by_slope = read_by_one_slope(lab),
            .bias_temperature_coefficient_per_c = task.said.gyro.bias_temperature_coefficient_per_c,
            .half_wave_temperature_coefficient_per_c = task.said.piezo.half_wave_temperature_coefficient_per_c,
            .field = fields_of(task, lab)};
}

std::vector<CalibratedLog> summaries(const std::vector<calibration::LabLog>& logs) {
    std::vector<CalibratedLog> all;
    for (const calibration::LabLog& log : logs)
        all.push_back({.path = log.name,
                       .duration_s = static_cast<double>(log.n_ticks) * log.tick_s,
                       .segments = std::ssize(log.segments),
                       .relocks = std::ssize(log.relocks),
                       .has_temperature = log.has_temperature(),
                       .temperature_min_c = log.temperature_min_c,
                       .temperature_max_c = log.temperature_max_c});
    return all;
}

// A bias frequency that was carried to the reference temperature from afar by a coefficient that nobody knows; empty
// where it was not.
std::string far_reference(const CalibrationTask& task, const Lab& lab, const calibration::Calibration& calibration) {
    constexpr double far_c = 5.0;
    for (const calibration::Constant& c : calibration.constants) {
        if (c.key == "gyro.bias_hz" && !c.estimate.determined) return {};
        if (c.key == bias_coefficient && c.estimate.determined) return {};
    }
    if (config::is_given(task.said, bias_coefficient)) return {};
    const double reference_c = lab.configs.front().gyro.reference_temperature_c;
    double nearest_c = std::numeric_limits<double>::infinity();
    for (const calibration::LabLog& log : lab.logs)
        if (log.has_temperature())
            nearest_c =
                std::min(nearest_c, std::max(log.temperature_min_c - reference_c, reference_c - log.temperature_max_c));
    if (!(nearest_c > far_c) || !std::isfinite(nearest_c)) return {};
    return fmt::format(
        "gyro.bias_hz is that of the logs, {:.3g} C or more from gyro.reference_temperature_c = {:g} C; "
        "{} is neither determined nor given",
        nearest_c, reference_c, bias_coefficient);
}

// Coefficients that were found were not presumed.
std::string presumed_line(const Lab& lab, const calibration::Calibration& found) {
    std::vector<std::string_view> keys{"gyro.reference_temperature_c"};
    for (const calibration::Constant& c : found.constants)
        if (!c.estimate.determined && c.key.ends_with("temperature_coefficient_per_c")) keys.push_back(c.key);
    const std::string list = config::not_given(lab.configs.front(), keys);
    return list.empty() ? list : fmt::format("presumed, given by neither log nor configuration: {}", list);
}

// A bias that does not show is none of a log whose bias is found: it is smaller than was presumed.
void add_contradictions(const Lab& lab, CalibrationResult& result) {
    const std::vector<calibration::Constant>& constants = result.calibration.constants;
    const bool shows = std::ranges::any_of(
        constants, [](const calibration::Constant& c) { return c.key == "gyro.bias_hz" && c.estimate.determined; });
    for (std::size_t k = 0; k < lab.signs.size(); ++k) {
        const std::string complaint = lab.signs[k].complaint(lab.logs[k].name);
        if (!complaint.empty() && (lab.signs[k].is_contradicted() || !shows)) result.warnings.push_back(complaint);
    }
}

// What no configuration may hold is no constant of a gyro.
void refuse_beyond_ranges(calibration::Calibration& found) {
    for (calibration::Constant& c : found.constants) {
        if (!c.estimate.determined || c.key.find('.') == std::string::npos) continue;
        try {
            config::Config any;
            config::apply_pair(any, c.key, fmt::format("{}", c.estimate.value), "it comes out as");
        } catch (const config::ConfigError& error) {
            c.estimate = numeric::refused(error.what());
        }
    }
    const auto chi = std::ranges::find(found.constants, "gyro.bias_chi", &calibration::Constant::key);
    if (chi == found.constants.end() || !chi->estimate.determined) return found.chi_higher.clear();
    try {
        config::Config any;
        config::apply_pair(any, "gyro.bias_chi_higher", fmt::format("[{}]", fmt::join(found.chi_higher, ", ")),
                           "it comes out as");
    } catch (const config::ConfigError& error) {
        chi->estimate = numeric::refused(error.what());
        found.chi_higher.clear();
    }
}

}  // namespace

bool CalibrationResult::any_determined() const {
    return std::ranges::any_of(calibration.constants,
                               [](const calibration::Constant& c) { return c.estimate.determined; });
}

CalibrationResult calibrate(const CalibrationTask& task) {
    check(task);
    Lab lab = read_all(task);
    check_agreement(task, lab);
    CalibrationResult result{.calibration = calibration::calibrate(lab.logs, presumed(task, lab)),
                             .logs = summaries(lab.logs),
                             .config = lab.configs.front(),
                             .slope_per_lambda = std::abs(lab.recorded.front().gyro.discriminator_per_lambda),
                             .warnings = std::move(lab.warnings)};
    refuse_beyond_ranges(result.calibration);
    add_contradictions(lab, result);
    if (const std::string line = presumed_line(lab, result.calibration); !line.empty()) result.warnings.push_back(line);
    result.reference_warning = far_reference(task, lab, result.calibration);
    if (!result.reference_warning.empty()) result.warnings.push_back(result.reference_warning);
    return result;
}

}  // namespace zlg::study
