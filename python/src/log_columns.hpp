#pragma once
// Logs as columns: what Python sees of records and rows.

#include <cstdint>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/raw_log.hpp>

#include "arrays.hpp"

namespace zlg::python {

// Collects half-periods; the arrays of `take_out` are its own memory.
class RawCollector {
public:
    void reserve(std::size_t halves);
    void add(const core::HalfRecord& record, const core::LightSamples& light = {});
    [[nodiscard]] py::dict take_out();

private:
    std::vector<std::int64_t> half_, counts_;
    std::vector<std::int8_t> bias_sign_, mode_;
    std::vector<std::uint8_t> loop_closed_, valid_;
    std::vector<double> detuning_, detuning_sq_, piezo_, temperature_;
    std::vector<std::int32_t> edge_offset_, span_;
    std::vector<float> light_a_, light_b_;
};

// Which columns a raw log has; its settings stay empty.
[[nodiscard]] logs::RawHeader header_of(const py::dict& columns, double timer_hz);

// The columns of a raw log as Python holds them, to be read where the interpreter is released.
class RawView {
public:
    // errors  ValueError: columns of different lengths, rows that no reader would accept.
    explicit RawView(const py::dict& columns);

    [[nodiscard]] std::size_t size() const { return counts_.size(); }
    [[nodiscard]] core::HalfRecord record(std::size_t row) const;
    [[nodiscard]] core::LightSamples light(std::size_t row) const;
    [[nodiscard]] int light_samples() const { return static_cast<int>(n_light_); }
    [[nodiscard]] bool has_light_b() const { return !light_b_.empty(); }
    [[nodiscard]] bool has_edge_offset() const { return !edge_offset_.empty(); }

private:
    template <class T>
    std::span<const T> hold(const py::dict& columns, const char* name);
    void refuse_bad_rows() const;
    void refuse_bad_spans() const;
    std::span<const float> hold_light(const py::dict& columns, const char* name);

    std::vector<py::object> held_;
    std::span<const std::int64_t> counts_;
    std::span<const std::int8_t> bias_sign_, mode_;
    std::span<const std::uint8_t> loop_closed_, valid_;
    std::span<const double> detuning_, detuning_sq_, piezo_, temperature_;
    std::span<const std::int32_t> edge_offset_, span_;
    std::span<const float> light_a_, light_b_;
    std::size_t n_light_ = 0;
};

// Collects the rows of an angle log.
class AngleCollector {
public:
    void reserve(std::size_t ticks);
    void add(const core::AngleRow& row, double true_arcsec);
    void add(const core::AngleRow& row);
    [[nodiscard]] std::size_t size() const { return tick_.size(); }
    [[nodiscard]] py::dict take_out();

private:
    std::vector<std::int64_t> tick_;
    std::vector<double> dtheta_, final_, sigma_, truth_;
    std::vector<std::int8_t> mode_;
    std::vector<std::uint32_t> flags_;
};

}  // namespace zlg::python
