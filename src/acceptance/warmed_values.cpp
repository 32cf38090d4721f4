// Temperature, warming, and magnetic fields.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>
#include <Eigen/Core>

#include <zlg/deviations/series.hpp>
#include <zlg/noise/bias_temperature.hpp>
#include <zlg/noise/mode_split.hpp>
#include <zlg/report/number_text.hpp>

#include "moved_values.hpp"

namespace zlg::acceptance {
namespace {

constexpr const char* slope = "bias_temperature.deg_h_c";
constexpr const char* hysteresis = "bias_hysteresis.deg_h";
constexpr const char* settling = "warm_up.s";
constexpr const char* sensitivity = "magnetic_sensitivity.deg_h_mt";

// Rate and temperature, as means over a stretch of the run.
struct Point {
    double time_s = 0.0, rate = 0.0, temperature_c = 0.0;
};

// Of what is known from one time to another; NaN: nothing.
double mean_over(const std::vector<double>& values, double from, double to) {
    double known = 0.0, sum = 0.0;
    const auto end = std::min(values.size(), static_cast<std::size_t>(to));
    for (auto k = static_cast<std::size_t>(std::max(0.0, from)); k < end; ++k)
        if (std::isfinite(values[k])) known += 1.0, sum += values[k];
    return sum / known;
}

// Of a switched gyro its non-magnetic part, by three segments each; else means over 128 equal stretches. The
// temperature, where it was measured, is the mean around each.
std::vector<Point> course_of(const study::AxisRecord& axis) {
    constexpr double n_stretches = 128.0;
    const double length_s = static_cast<double>(axis.rates_arcsec_s.size()) / axis.rate_hz;
    std::vector<Point> course;
    double apart_s = length_s / n_stretches;
    if (!axis.mode.empty()) {
        const noise::ModeSplit split = noise::split_modes(
            {.rate_hz = axis.rate_hz, .rates_arcsec_s = axis.rates_arcsec_s, .bridged_arcsec_s = {}, .mode = axis.mode},
            20);
        // Each is made of three segments: only every third is one of its own.
        for (std::size_t k = 1; k < split.points.size(); k += 3)
            course.push_back({split.points[k].time_s, split.points[k].nonmagnetic_arcsec_s, 0.0});
        if (course.size() > 1) apart_s = course[1].time_s - course[0].time_s;
    }
    const auto around = [&](const std::vector<double>& values, double time_s) {
        return mean_over(values, (time_s - 0.5 * apart_s) * axis.rate_hz, (time_s + 0.5 * apart_s) * axis.rate_hz);
    };
    if (course.empty())
        for (double k = 0.5; k < n_stretches; k += 1.0)
            course.push_back({k * apart_s, around(axis.rates_arcsec_s, k * apart_s), 0.0});
    for (Point& p : course) p.temperature_c = around(axis.temperature_c, p.time_s);
    std::erase_if(course, [](const Point& p) { return !std::isfinite(p.rate); });
    return course;
}

report::Figure course_figure(const RunRecord& record, std::size_t axis, const std::vector<Point>& course,
                             const char* title, bool over_temperature) {
    report::Figure f =
        report::blank_figure(fmt::format("course-of-run-{}-{}", record.run->number, axis + 1),
                             fmt::format("{}, run {}", title, record.run->number),
                             "Means over stretches of the run; of a switched gyro its non-magnetic part.",
                             over_temperature ? "temperature, C" : "time, s", "rate, deg/h");
    report::Series points = report::blank_series("means", report::Mark::points);
    for (const Point& p : course) report::add_point(points, over_temperature ? p.temperature_c : p.time_s, p.rate);
    f.series = {std::move(points)};
    return f;
}

// When the bias was last seen outside the band, and when it may have been at the earliest and at the latest.
struct Settling {
    double seen_s = 0.0, earliest_s = 0.0, latest_s = 0.0;
};

// Each mean of the course, over the quarter of its time around it, against that of the last quarter of the run. What
// it may be off by: noise, from the steps of the second half, and the end itself, which may still move: of a decay by q
// a quarter q/(1 - q) of what the last quarter differs by from the one before, beyond noise, is left. A slower one may
// hide under it: twice that counts, up to three times, as much as one leaves that takes up to 0.85 of the run.
Settling settling_in(const std::vector<Point>& course, double band) {
    const std::size_t n = course.size(), quarter = n / 4;
    std::vector<double> sums{0.0};
    for (const Point& p : course) sums.push_back(sums.back() + p.rate);
    const auto mean = [&](std::size_t from, std::size_t to) {
        return (sums[to] - sums[from]) / static_cast<double>(to - from);
    };
    double steps = 0.0;
    for (std::size_t k = n / 2 + 1; k < n; ++k) steps += std::pow(course[k].rate - course[k - 1].rate, 2);
    const double variance = 0.5 * steps / static_cast<double>(n - n / 2 - 1), end = mean(n - quarter, n);
    const double apart = mean(n - 2 * quarter, n - quarter) - end;
    const double before = mean(n - 3 * quarter, n - 2 * quarter) - mean(n - 2 * quarter, n - quarter);
    const double q = apart / before, left = q >= 0.0 && q < 0.6 ? 2.0 * q / (1.0 - q) : 3.0;
    const double moves = left * std::sqrt(std::max(0.0, apart * apart - 2.0 * variance / static_cast<double>(quarter)));
    Settling s;
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t from = k - k / 8, to = std::min(n, k + k / 8 + 1);
        const double off = std::abs(mean(from, to) - end), parts = 1.0 / static_cast<double>(to - from);
        const double slack =
            std::hypot(z_95 * std::sqrt(variance * (parts + 1.0 / static_cast<double>(quarter))), moves);
        const double time_s = k + 1 < n ? 0.5 * (course[k].time_s + course[k + 1].time_s) : course[k].time_s;
        if (off > band) s.seen_s = time_s;
        if (off - slack > band) s.earliest_s = time_s;
        if (off + slack > band) s.latest_s = time_s;
    }
    return s;
}

// Slope and hysteresis of one axis.
std::array<Value, 2> temperature_of(const RunRecord& record, std::size_t index, std::vector<report::Figure>& figures) {
    const study::AxisRecord& axis = record.axes[index];
    const auto refuse = [](const std::string& why) {
        return std::array{not_determined(slope, why), not_determined(hysteresis, why)};
    };
    if (axis.temperature_c.empty()) return refuse("needs a log with temperature_c");
    std::vector<Point> course = course_of(axis);
    std::erase_if(course, [](const Point& p) { return !std::isfinite(p.temperature_c); });
    std::vector<double> rates, temperatures;
    for (const Point& p : course) {
        rates.push_back(p.rate);
        temperatures.push_back(p.temperature_c);
    }
    noise::BiasTemperature law;
    try {
        law = noise::bias_temperature({.rates_arcsec_s = rates, .temperature_c = temperatures});
    } catch (const deviations::SeriesError& error) {
        return refuse(error.what());
    }
    if (law.most_c - law.least_c < 1.0) return refuse("needs a range of temperatures of 1 C or more");
    figures.push_back(course_figure(record, index, course, "Rate against temperature", true));
    const double hours = (course.back().time_s - course.front().time_s) / 3600.0;
    const auto value_of = [hours](const char* name, const numeric::Estimate& e, double value) {
        if (!e.determined) return not_determined(name, e.reason);
        return measured(name, value, e.sigma, std::numeric_limits<double>::infinity(), hours);
    };
    return {value_of(slope, law.bias[1], law.bias[1].value),
            value_of(hysteresis, law.hysteresis_arcsec_s, std::abs(law.hysteresis_arcsec_s.value))};
}

// Time from the start until the bias stays within the band about its end.
Value settling_of(const RunRecord& record, std::size_t index, double band, std::vector<report::Figure>& figures) {
    const std::vector<Point> course = course_of(record.axes[index]);
    if (course.size() < 16) return not_determined(settling, "needs 16 means over the run");
    figures.push_back(course_figure(record, index, course, "Warming", false));
    const double length_s = course.back().time_s;
    const Settling found = settling_in(course, band);
    if (!(found.latest_s < 0.75 * length_s))
        return not_determined(settling, "needs a longer run: at the end it is not sure that the bias has settled");
    // Known to the length of a stretch.
    const double stretch_s = length_s / static_cast<double>(course.size());
    const double off_s = std::max(found.latest_s - found.seen_s, found.seen_s - found.earliest_s);
    Value v = measured(settling, found.seen_s, std::hypot(off_s / z_95, stretch_s / std::sqrt(12.0)),
                       std::numeric_limits<double>::infinity(), length_s / 3600.0);
    v.reason = "last time outside the band about the last quarter of the run";
    return v;
}

}  // namespace

Found temperature_values(const std::vector<RunRecord*>& records) {
    Found found;
    std::vector<Value> slopes, widths;
    for (const RunRecord* record : records)
        for (std::size_t k = 0; k < record->axes.size(); ++k) {
            auto [one, width] = temperature_of(*record, k, found.figures);
            slopes.push_back(std::move(one));
            widths.push_back(std::move(width));
        }
    found.values = {together(slopes), largest(widths)};
    return found;
}

Found warm_up_values(const Plan& plan, const std::vector<RunRecord*>& records) {
    const double band = plan.warm_up_band_deg_h;
    if (band == 0.0)
        return {
            .values = {not_determined(settling, "needs [accept] warm_up_band_deg_h: within which the bias settles")}};
    Found found;
    std::vector<Value> times;
    for (const RunRecord* record : records)
        for (std::size_t k = 0; k < record->axes.size(); ++k)
            times.push_back(settling_of(*record, k, band, found.figures));
    found.values = {largest(times)};
    return found;
}

Found magnetic_values(const Plan& plan, const std::vector<StillAxis>& in_field) {
    Found found;
    std::vector<double> fields, biases, weights;
    // The run that knows its error least; what a longer record gives is that of the run which it helps least.
    Value of = measured(sensitivity, 0.0, 0.0, std::numeric_limits<double>::infinity(), 0.0);
    of.moves = 0.0;
    report::Series points = report::blank_series("runs", report::Mark::points);
    for (const StillAxis& axis : in_field) {
        const Value bias = bias_of(plan, axis);
        if (!bias.determined) continue;
        fields.push_back(axis.run->field_mt);
        biases.push_back(bias.value);
        weights.push_back(1.0 / (bias.uncertainty * bias.uncertainty));
        of.hours += bias.hours;
        of.degrees = std::min(of.degrees, bias.degrees);
        of.longer = std::max(of.longer, bias.longer);
        of.moves = std::max(of.moves, bias.moves);
        report::add_point(points, axis.run->field_mt, bias.value);
        points.y_error.push_back(2.0 * bias.uncertainty);
    }
    const auto n = std::ssize(fields);
    const Eigen::Map<const Eigen::ArrayXd> field(fields.data(), n), bias(biases.data(), n), weight(weights.data(), n);
    const Eigen::ArrayXd x = field - (weight * field).sum() / weight.sum(),
                         y = bias - (weight * bias).sum() / weight.sum();
    const double xx = (weight * x * x).sum();
    if (!(xx > 0.0) || !std::isfinite(xx)) return found;
    of.value = (weight * x * y).sum() / xx;
    of.uncertainty = 1.0 / std::sqrt(xx);
    const Eigen::ArrayXd residual = y - of.value * x;
    const double tested = (weight * residual * residual).sum();
    report::Figure f =
        report::blank_figure("field", "Bias in a magnetic field",
                             "Bias of each run, with twice its standard uncertainty.", "field, mT", "bias, deg/h");
    f.series = {std::move(points)};
    found.figures = {std::move(f)};
    if (const double free = static_cast<double>(n) - 2.0; free > 0.0) {
        if (scatters(tested, free))
            of = measured(sensitivity, of.value, of.uncertainty * std::sqrt(tested / free), free, of.hours);
        found.values.push_back(
            deviation("magnetic_residual.deg_h", std::sqrt(residual.square().sum() / free), free, of.hours));
    }
    found.values.push_back(std::move(of));
    return found;
}

}  // namespace zlg::acceptance
