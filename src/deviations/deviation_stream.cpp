#include <zlg/deviations/deviation_stream.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "deviation_points.hpp"
#include "long_sum.hpp"
#include "stream_level.hpp"

namespace zlg::deviations {
namespace {

constexpr std::int64_t min_window = 64;
constexpr std::int64_t max_window = std::int64_t{1} << 24;
constexpr std::int64_t max_factor = std::int64_t{1} << 46;  // counts of its samples, summed over it, stay exact
constexpr std::size_t piece_samples = 65536;

void check(const StreamConfig& config) {
    constexpr std::array one_sample{0.0};
    check(Series{.what = config.what, .values = one_sample});
    const auto window = static_cast<std::uint64_t>(config.window);
    if (config.window < min_window || config.window > max_window || !std::has_single_bit(window))
        throw SeriesError(
            fmt::format("window: {}, allowed is a power of two from {} to {}", config.window, min_window, max_window));
    if (config.kinds.empty()) throw SeriesError("stream: 0 kinds of deviation, allowed is 1 or more");
    for (const auto kind : config.kinds)
        if (kind != DeviationKind::oadev && kind != DeviationKind::mdev && kind != DeviationKind::tdev &&
            kind != DeviationKind::ohdev)
            throw SeriesError(
                fmt::format("stream: {} needs the whole record, allowed are oadev, mdev, tdev, ohdev", name_of(kind)));
    if (config.factors.empty()) throw SeriesError("averaging times: 0 are given, allowed is 1 or more");
    for (const auto m : config.factors)
        if (m < 1 || m > max_factor)
            throw SeriesError(fmt::format("averaging time: {} intervals, allowed is 1 to {}", m, max_factor));
    check(DeviationOptions{.least_known_ratio = config.least_known_ratio});
}

struct Placed {
    std::int64_t m;  // intervals
    std::size_t level;
};

std::vector<Placed> place(const std::vector<std::int64_t>& factors, std::int64_t window) {
    std::vector<Placed> placed;
    for (const std::int64_t m : factors) {
        std::size_t level = 0;
        while ((window << level) < m) ++level;
        const std::int64_t stride = std::int64_t{1} << level;
        placed.push_back({.m = (m + stride / 2) / stride * stride, .level = level});
    }
    std::ranges::sort(placed, {}, &Placed::m);
    const auto same = [](const Placed& a, const Placed& b) { return a.m == b.m; };
    placed.erase(std::unique(placed.begin(), placed.end(), same), placed.end());
    return placed;
}

}  // namespace

struct DeviationStream::State {
    explicit State(const StreamConfig& given) : config(given), factors(place(given.factors, given.window)) {
        const bool averages = std::ranges::any_of(config.kinds, is_modified);
        for (std::size_t l = 0; l <= factors.back().level; ++l)
            levels.emplace_back(std::int64_t{1} << l, config.window, averages);
        carried.resize(levels.size());
        for (const auto& factor : factors)
            levels[factor.level].add_factor(factor.m / levels[factor.level].stride(), config.kinds);
        for (std::int64_t m = 1; m <= config.window; m *= 2) levels.front().add_noise(m);
        for (std::size_t l = 1; l < levels.size(); ++l) levels[l].add_noise(config.window);
        gaps.is_phase = config.what.kind == DataKind::phase;
        gaps.least_known_ratio = config.least_known_ratio;
        if (!gaps.is_phase) border(0.0);
    }

    // A border of the stream goes to every level whose stride divides its number; with it the sums of the borders since
    // the last one are complete.
    void border(double at) {
        const auto number = static_cast<std::uint64_t>(n_borders++);
        const auto known = static_cast<double>(n_known);
        for (std::size_t l = 0; l < levels.size(); ++l) {
            if (number % (std::uint64_t{1} << l) != 0) break;
            levels[l].push_border(at, known, gaps);
        }
        std::pair<double, double> sum{at, known};
        for (std::size_t l = 0; l < levels.size(); ++l) {
            levels[l].push_average(sum.first, sum.second, gaps);
            if ((number >> l) % 2 == 0) {
                carried[l] = sum;
                break;
            }
            sum = {carried[l].first + sum.first, carried[l].second + sum.second};
        }
    }

    void sample(double value, bool valid) {
        const bool known = valid && std::isfinite(value);
        if (!known) gaps.any = true;
        ++n_samples;
        if (gaps.is_phase) {
            n_known += known ? 1 : 0;
            border(known ? value : std::numeric_limits<double>::quiet_NaN());
            return;
        }
        if (known) {
            angle.add(value - origin);
            ++n_known;
        }
        border(angle.value());
    }

    // No deviation depends on what is taken off every sample, but the sum stays short.
    void find_origin(std::span<const double> values, std::span<const std::uint8_t> valid) {
        if (n_known > 0) return;
        LongSum total;
        double n = 0.0;
        for (std::size_t k = 0; k < values.size(); ++k)
            if (std::isfinite(values[k]) && (valid.empty() || valid[k] != 0)) {
                total.add(values[k]);
                ++n;
            }
        if (n > 0.0) origin = total.value() / n;
    }

    StreamConfig config;
    std::vector<Placed> factors;
    std::vector<StreamLevel> levels;
    std::vector<std::pair<double, double>> carried;  // sums that wait for their other half
    StreamGaps gaps;
    LongSum angle;
    double origin = 0.0;
    std::int64_t n_borders = 0, n_samples = 0, n_known = 0;
};

DeviationStream::DeviationStream(const StreamConfig& config)
    : state_((check(config), std::make_unique<State>(config))) {}
DeviationStream::~DeviationStream() = default;
DeviationStream::DeviationStream(DeviationStream&&) noexcept = default;

void DeviationStream::add(std::span<const double> values, std::span<const std::uint8_t> valid) {
    if (!valid.empty() && valid.size() != values.size())
        throw SeriesError(fmt::format("validity: {} marks for {} samples", valid.size(), values.size()));
    state_->find_origin(values, valid);
    for (std::size_t k = 0; k < values.size(); ++k) state_->sample(values[k], valid.empty() || valid[k] != 0);
}

DeviationCurve DeviationStream::curve(DeviationKind kind, const DeviationOptions& options) const {
    check(options);
    const auto& state = *state_;
    if (std::ranges::find(state.config.kinds, kind) == state.config.kinds.end())
        throw SeriesError(fmt::format("stream: {} was not asked for at its beginning", name_of(kind)));
    const std::int64_t n_intervals = state.n_borders - 1;
    std::vector<MeasuredSum> sums;
    for (const auto& [m, l] : state.factors) {
        const auto& level = state.levels[l];
        const std::int64_t possible = possible_terms(kind, m, n_intervals);
        sums.push_back({.m = m,
                        .sum = level.sum_of(kind, m / level.stride(), state.gaps),
                        .possible_terms = (possible + level.stride() - 1) / level.stride()});
    }
    std::vector<NoiseStep> steps;
    if (!options.noise)
        for (const auto& level : state.levels) level.append_steps(steps, state.gaps);
    return curve_of(kind, state.config.what, n_intervals, sums, steps, options);
}

std::int64_t DeviationStream::n_samples() const { return state_->n_samples; }
std::int64_t DeviationStream::n_known() const { return state_->n_known; }

std::size_t DeviationStream::memory_bytes() const {
    std::size_t bytes = sizeof(State);
    for (const auto& level : state_->levels) bytes += sizeof(level) + level.memory_bytes();
    return bytes;
}

void read_into(DeviationStream& stream, const SampleSource& source) {
    std::vector<double> values(piece_samples);
    std::vector<std::uint8_t> valid(piece_samples);
    for (;;) {
        const std::size_t n = std::min(source(values, valid), piece_samples);
        if (n == 0) return;
        stream.add(std::span(values).first(n), std::span(valid).first(n));
    }
}

}  // namespace zlg::deviations
