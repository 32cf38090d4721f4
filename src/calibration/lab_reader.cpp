#include <zlg/calibration/lab_reader.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rest_start.hpp"

namespace zlg::calibration {
namespace {

constexpr std::size_t window_halves = 2 * window_ticks;

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
    recent_.reserve(window_halves);
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
    if (gap_before_) log_.relocks.push_back({.segment = std::ssize(log_.segments) - 1, .halves = {}});
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
    if (recent_.size() < window_halves) {
        recent_.push_back(record);
        return;
    }
    recent_[oldest_] = record;
    oldest_ = (oldest_ + 1) % window_halves;
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
        for (const core::HalfRecord& r : recent_) add_reading(log_.segments.back().at_end, r);
    for (std::size_t k = 0; k < n_starts; ++k)
        if (start_voltage_[k].n > 1) window_variance_[k].add(start_voltage_[k].variance());
    start_voltage_ = {};
    recent_.clear();
    oldest_ = 0;
    in_segment_ = false;
}

}  // namespace zlg::calibration
