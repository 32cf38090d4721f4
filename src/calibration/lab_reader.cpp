#include <zlg/calibration/lab_reader.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace zlg::calibration {

double slope_v_per_tick(const Segment& s) {
    constexpr double apart_ticks = static_cast<double>(window_ticks) - 0.5;
    if (!(s.at_start.n > 0 && s.at_end.middle_ticks - s.at_start.middle_ticks > apart_ticks)) return 0.0;
    return (s.at_end.voltage_v - s.at_start.voltage_v) / (s.at_end.middle_ticks - s.at_start.middle_ticks);
}

bool is_whole(const Relock& relock, double core::HalfRecord::*column) {
    return relock.halves.size() == relock_halves &&
           std::ranges::all_of(relock.halves, [&](const core::HalfRecord& r) { return std::isfinite(r.*column); });
}

void Moments::add(const Moments& other) {
    if (other.n == 0) return;
    const auto ours = static_cast<double>(n);
    const auto theirs = static_cast<double>(other.n);
    const double apart = other.mean - mean;
    sum_sq += other.sum_sq + apart * apart * ours * theirs / (ours + theirs);
    mean += apart * theirs / (ours + theirs);
    n += other.n;
}

namespace {

// When the perimeter is at rest after a re-lock, from how the detuning decays.
constexpr std::int64_t min_relocks_of_decay = 4;
constexpr double noise_sigmas = 4.0;
constexpr double as_long_again = 1.5;
constexpr std::size_t tail_halves = 8;

std::vector<Moments> decay_of(const std::vector<Relock>& relocks) {
    std::vector<Moments> decay(relock_halves);
    for (const Relock& relock : relocks) {
        if (!is_whole(relock, &core::HalfRecord::detuning_lambda)) continue;
        const double sign = std::copysign(1.0, relock.halves.front().detuning_lambda);
        for (std::size_t h = 0; h < relock_halves; ++h) decay[h].add(sign * relock.halves[h].detuning_lambda);
    }
    return decay;
}

// Of a mean, from the last halves together: that of a few re-locks alone would be known too badly.
double noise_of(const std::vector<Moments>& decay) {
    double variance = 0.0;
    for (std::size_t h = relock_halves - tail_halves; h < relock_halves; ++h)
        variance += decay[h].variance() / static_cast<double>(tail_halves);
    return noise_sigmas * std::sqrt(variance / static_cast<double>(decay.front().n));
}

double mean_over(const std::vector<Moments>& decay, std::size_t from) {
    double sum = 0.0;
    for (std::size_t h = from; h < from + tail_halves; ++h) sum += std::abs(decay[h].mean);
    return sum / static_cast<double>(tail_halves);
}

// Until the tail of what was kept has fallen to noise: it decays as it did over the later half of it.
double beyond_kept_halves(const std::vector<Moments>& decay, double noise) {
    const std::size_t from = relock_halves / 2;
    const std::size_t to = relock_halves - tail_halves;
    const double folds = std::log(mean_over(decay, from) / mean_over(decay, to));
    if (!(folds > 0.0)) return std::numeric_limits<double>::infinity();
    const double to_noise = std::log(mean_over(decay, to) / noise);
    return std::fmax(0.0, to_noise) * static_cast<double>(to - from) / folds;
}

// Mean detuning of each half over the re-locks, with the sign of the first half of each. Until it has fallen to noise,
// and half as long again: what is left is then well below the noise of the mean. A decay that outlasts the halves kept
// goes on as an exponential.
//
// return  settled_after_ticks or more; infinite where the detuning does not decay; settled_after_ticks where the column
//         detuning_lambda is missing or fewer than 4 re-locks are whole.
double rest_after_ticks(const std::vector<Relock>& relocks) {
    constexpr auto least = static_cast<double>(settled_after_ticks);
    const std::vector<Moments> decay = decay_of(relocks);
    if (decay.front().n < min_relocks_of_decay) return least;
    const double noise = noise_of(decay);
    std::size_t halves = relock_halves;
    while (halves > 0 && !(std::abs(decay[halves - 1].mean) > noise)) --halves;
    double until_halves = static_cast<double>(halves);
    if (halves + tail_halves > relock_halves) until_halves += beyond_kept_halves(decay, noise);
    return std::fmax(least, 0.5 * as_long_again * until_halves);
}

constexpr std::size_t window_halves = 2 * window_ticks;

// The control decides by its last 8 readings whether the voltage goes up or down. Readings that decided are not a fair
// sample: near the middle of the range they are too low where it goes up, too high where it goes down, and the step
// would be found too long.
constexpr std::size_t steering_halves = 8;

constexpr std::int64_t start_ticks(std::size_t k) { return settled_after_ticks << k; }

int bias_and_mode(const core::HalfRecord& r) { return r.bias_sign * r.mode; }

void add_reading(PiezoLevel& level, const core::HalfRecord& r) {
    if (!std::isfinite(r.piezo_v)) return;
    ++level.n;
    const auto n = static_cast<double>(level.n);
    level.voltage_v += (r.piezo_v - level.voltage_v) / n;
    level.temperature_c += (r.temperature_c - level.temperature_c) / n;
    level.middle_ticks += (0.5 * static_cast<double>(r.half + 1) - level.middle_ticks) / n;
}

}  // namespace

LabReader::LabReader(std::string name, double tick_s) {
    log_.name = std::move(name);
    log_.tick_s = tick_s;
    recent_.reserve(window_halves + steering_halves);
}

void LabReader::take(const core::HalfRecord& record) {
    const double step_v = std::abs(record.piezo_v - last_piezo_v_);
    if (step_v > 0.0) log_.piezo_quantum_v = std::min(log_.piezo_quantum_v, step_v);
    last_piezo_v_ = record.piezo_v;
    has_first_ = !has_first_;
    if (has_first_) {
        first_ = record;
        return;
    }
    take_tick(first_, record);
    ++log_.n_ticks;
}

LabLog LabReader::finish() {
    end_segment();
    choose_start();
    return std::move(log_);
}

void LabReader::take_tick(const core::HalfRecord& first, const core::HalfRecord& second) {
    const bool good = is_measured(first, second) && first.mode == second.mode;
    if (!good) {
        end_segment();
        gap_before_ = true;
        gap_end_ = core::border_of(second);
        return;
    }
    if (in_segment_ && log_.segments.back().mode != first.mode) end_segment();
    if (!in_segment_) begin_segment(first);
    Segment& segment = log_.segments.back();
    ++segment.n_ticks;
    if (segment.after_gap && log_.relocks.back().halves.size() < relock_halves) {
        log_.relocks.back().halves.push_back(first);
        log_.relocks.back().halves.push_back(second);
    }
    if (segment.n_ticks > settled_after_ticks) take_settled(first, second);
}

void LabReader::begin_segment(const core::HalfRecord& first) {
    in_segment_ = true;
    log_.segments.push_back({.mode = first.mode, .after_gap = gap_before_, .first_tick = first.half / 2});
    if (gap_before_)
        log_.relocks.push_back({.segment = std::ssize(log_.segments) - 1, .halves = {}, .before = gap_end_});
    starts_.emplace_back();
    gap_before_ = false;
    log_.scatter.interrupt();
}

void LabReader::take_settled(const core::HalfRecord& first, const core::HalfRecord& second) {
    Segment& segment = log_.segments.back();
    const std::int64_t index = std::ssize(log_.segments) - 1;
    ++segment.n_settled;
    if (log_.blocks.empty() || log_.blocks.back().segment != index || log_.blocks.back().n_ticks == block_ticks)
        log_.blocks.push_back({.segment = index,
                               .first_tick = first.half / 2,
                               .mode = first.mode,
                               .first_sign = static_cast<std::int8_t>(bias_and_mode(first)),
                               .first_temperature_c = first.temperature_c});
    Block& block = log_.blocks.back();
    ++block.n_ticks;
    block.last_temperature_c = second.temperature_c;
    for (const core::HalfRecord* r : {&first, &second}) {
        block.counts += r->counts;
        block.difference += bias_and_mode(*r) * r->counts;
        block.temperature_sum_c += r->temperature_c;
        if (std::isfinite(r->detuning_sq_lambda2)) log_.square.add(r->detuning_sq_lambda2);
        if (std::isfinite(r->temperature_c)) {
            log_.temperature_min_c = std::min(log_.temperature_min_c, r->temperature_c);
            log_.temperature_max_c = std::max(log_.temperature_max_c, r->temperature_c);
        }
        take_window(*r);
    }
    log_.scatter.take(first.counts + second.counts);
}

void LabReader::take_window(const core::HalfRecord& record) {
    const std::int64_t tick = log_.segments.back().n_ticks - 1;
    for (std::size_t k = 0; k < n_starts; ++k) {
        if (tick < start_ticks(k) || tick >= start_ticks(k) + window_ticks) continue;
        add_reading(starts_.back()[k], record);
        if (std::isfinite(record.piezo_v)) start_voltage_[k].add(record.piezo_v);
    }
    if (recent_.size() < window_halves + steering_halves) {
        recent_.push_back(record);
        return;
    }
    recent_[oldest_] = record;
    oldest_ = (oldest_ + 1) % recent_.size();
}

void LabReader::choose_start() {
    log_.rest_after_ticks = rest_after_ticks(log_.relocks);
    std::size_t k = 0;
    while (k < n_starts && static_cast<double>(start_ticks(k)) < log_.rest_after_ticks) ++k;
    if (k == n_starts) return;
    log_.rest_after_ticks = static_cast<double>(start_ticks(k));
    log_.piezo_variance_v2 = window_variance_[k].mean;
    for (std::size_t s = 0; s < log_.segments.size(); ++s)
        if (log_.segments[s].n_ticks >= start_ticks(k) + window_ticks) log_.segments[s].at_start = starts_[s][k];
}

void LabReader::end_segment() {
    if (in_segment_)
        for (std::size_t k = 0; k < std::min(recent_.size(), window_halves); ++k)
            add_reading(log_.segments.back().at_end, recent_[(oldest_ + k) % recent_.size()]);
    for (std::size_t k = 0; k < n_starts; ++k)
        if (start_voltage_[k].n > 1) window_variance_[k].add(start_voltage_[k].variance());
    start_voltage_ = {};
    recent_.clear();
    oldest_ = 0;
    in_segment_ = false;
}

}  // namespace zlg::calibration
