// Rate tables.

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <zlg/calibration/rate_table.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/deviations/series.hpp>
#include <zlg/noise/line_error.hpp>

#include "moved_values.hpp"

namespace zlg::acceptance {
namespace {

using calibration::RateTable;
using calibration::TableStage;

constexpr const char* scale = "scale_factor.ppm";
constexpr const char* asymmetry = "scale_asymmetry.ppm";
constexpr const char* threshold = "threshold.deg_h";

// The error of the line took 17.5 s and 1.4 GB for 3000; time goes with their cube.
constexpr std::size_t most_stages = 1024;

struct Turned {
    const RunRecord* record = nullptr;
    RateTable table;
    double nominal = 1.0;  // nominal worth of a count over the one by which the rates were made
    double hours = 0.0;

    [[nodiscard]] double degrees() const { return std::max(1.0, static_cast<double>(table.stages.size()) - 2.0); }
};

// Less than three degrees of freedom do not show whether the rate walks.
noise::LineError error_of(const Turned& t) {
    if (t.degrees() < 3.0) return {.slope_sigma = t.table.scale_factor.sigma, .degrees = t.degrees()};
    std::vector<double> input, output;
    for (const TableStage& s : t.table.stages) input.push_back(s.input_arcsec_s), output.push_back(s.output);
    return noise::line_error(input, output);
}

std::vector<double> planned_rates(const Run& run, std::size_t n, double rate_hz) {
    std::vector<double> rates(n, std::numeric_limits<double>::quiet_NaN());
    const double length_s = static_cast<double>(n + 1) / rate_hz;
    if (!(run.stages.back().to_s <= length_s))
        throw config::ConfigError(
            fmt::format("{}: stages end at {:g} s, and the record at {:g} s; allowed is within it", run.place,
                        run.stages.back().to_s, static_cast<double>(n) / rate_hz));
    for (const Stage& stage : run.stages) {
        const auto at = [&](double s) { return std::min(n, static_cast<std::size_t>(std::ceil(s * rate_hz))); };
        for (std::size_t k = at(stage.from_s); k < at(stage.to_s); ++k) rates[k] = stage.rate_arcsec_s;
    }
    return rates;
}

// Why the stages tell nothing of this gyro; empty where they do.
std::string no_table(const RateTable& table) {
    double largest = 0.0;
    for (const TableStage& stage : table.stages) largest = std::max(largest, std::abs(stage.output));
    const double k = table.scale_factor.value;
    if (std::abs(k) < 0.1)
        return fmt::format(
            "the table was to turn, and the gyro shows {:.3g} deg/h at the most: the table stood, or this is another "
            "sensor",
            largest);
    if (k < 0.0) return "the gyro turns against the table: its polarity, or the sign of the plan, is the wrong one";
    if (std::abs(k - 1.0) > 0.1)
        return fmt::format("the scale factor is {:.4g} of the nominal one: the unit, or the sensor, is the wrong one",
                           k);
    if (table.largest_residual_ppm > 1e5)
        return "the gyro does not follow the table: the stages are not those of the plan, or this is another sensor";
    return {};
}

// The smallest rate at which the gyro shows at least half of it, where it does at all larger ones. The zero of the line
// is subtracted; a stage whose noise leaves that open does not count.
Value threshold_of(const Turned& of) {
    std::vector<TableStage> stages = of.table.stages;
    std::ranges::sort(stages, std::greater{}, [](const TableStage& s) { return std::abs(s.input_arcsec_s); });
    const double k = of.table.scale_factor.value, zero = of.table.bias_arcsec_s.value;
    double least = 0.0;
    for (const TableStage& s : stages) {
        const double input = s.input_arcsec_s, shown = s.output / k - zero;
        if (input == 0.0 || std::abs(input) < 2.0 * s.output_sigma || shown / input < 0.5) break;
        least = std::abs(input);
    }
    if (least == 0.0)
        return not_determined(threshold, "needs stages of small rates, each long enough to be told from 0");
    Value v = counted(threshold, least, of.hours);
    v.reason = "smallest rate of a stage at which the gyro showed half of it or more: an upper bound";
    return v;
}

std::vector<Turned> tables_of(const Plan& plan, const std::vector<RunRecord*>& records,
                              const config::Analysis& config) {
    std::vector<Turned> tables;
    for (RunRecord* record : records) {
        for (const study::AxisRecord& axis : record->axes) {
            const std::size_t n = axis.rates_arcsec_s.size();
            const bool by_plan = !record->run->stages.empty();
            if (!by_plan && record->table_rates_arcsec_s.size() != n)
                throw config::ConfigError(
                    fmt::format("{}: stages is missing: at which rates did the table turn? (or table_rate = COLUMN)",
                                record->run->place));
            Turned found{.record = record, .table = {}, .hours = static_cast<double>(n) / axis.rate_hz / 3600.0};
            if (plan.unit.scale_arcsec && !record->configs.empty())
                found.nominal = *plan.unit.scale_arcsec / record->configs.front().gyro.scale_arcsec;
            auto options = study::table_options(config, axis.rate_hz, n);
            options.earth_arcsec_s += earth_about(plan.unit, record->run->axis).value_or(0.0);
            try {
                found.table = calibration::rate_table(
                    by_plan ? planned_rates(*record->run, n, axis.rate_hz) : record->table_rates_arcsec_s,
                    axis.rates_arcsec_s, options);
            } catch (const deviations::SeriesError& error) {
                record->stops.emplace_back(error.what());
                continue;
            }
            if (found.table.stages.size() > most_stages)
                throw config::ConfigError(fmt::format("{}: the table has {} stages; allowed are up to {}",
                                                      record->run->place, found.table.stages.size(), most_stages));
            if (const std::string why = no_table(found.table); !why.empty()) record->stops.push_back(why);
            tables.push_back(std::move(found));
        }
    }
    return tables;
}

}  // namespace

Found table_values(const Plan& plan, const std::vector<RunRecord*>& records, const config::Analysis& config) {
    const std::vector<Turned> tables = tables_of(plan, records, config);
    Found found;
    if (tables.empty()) return found;
    std::vector<Value> scales, asymmetries;
    double squares = 0.0, free = 0.0, degrees = 0.0, hours = 0.0;
    std::string symmetric;
    for (const Turned& t : tables) {
        const numeric::Estimate &k = t.table.scale_factor, &a = t.table.asymmetry_ppm;
        const noise::LineError error = error_of(t);
        scales.push_back(measured(scale, 1e6 * (k.value * t.nominal - 1.0), 1e6 * t.nominal * error.slope_sigma,
                                  t.degrees(), t.hours));
        if (a.determined)
            asymmetries.push_back(measured(asymmetry, a.value, a.sigma, t.degrees(), t.hours));
        else
            symmetric = a.reason;
        squares += t.table.nonlinearity_ppm * t.table.nonlinearity_ppm * static_cast<double>(t.table.stages.size());
        free += t.degrees(), degrees += error.degrees;
        hours += t.hours;
        found.figures.push_back(study::residual_figure(config, t.table, fmt::format("run {}", t.record->run->number),
                                                       found.figures.size()));
        if (plan.unit.scale_arcsec && !(std::abs(k.value - 1.0) <= 0.1))
            found.wrong_scale =
                fmt::format("the rate table of run {} shows {:.4g} of the nominal scale, scale_arcsec = {:g}",
                            t.record->run->number, k.value, *plan.unit.scale_arcsec);
    }
    found.values.push_back(together(scales));
    found.values.push_back(deviation("scale_nonlinearity.ppm", std::sqrt(squares / free), degrees, hours));
    found.values.push_back(asymmetries.empty() ? not_determined(asymmetry, symmetric) : together(asymmetries));
    found.values.push_back(repeatability("scale_repeatability.ppm", scales, "needs two rate tables or more"));
    std::vector<Value> thresholds;
    for (const Turned& t : tables) thresholds.push_back(threshold_of(t));
    found.values.push_back(largest(thresholds));
    return found;
}

}  // namespace zlg::acceptance
