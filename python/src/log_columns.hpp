#pragma once
// Logs as columns: what Python sees of records and rows.

#include <utility>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/angle_layout.hpp>
#include <zlg/logs/raw_layout.hpp>

#include "arrays.hpp"

namespace zlg::python {

// The columns that are arrays in Python: all of a log but its first ones, which count the rows, as number and as time.
template <class Table, std::size_t n_counting> struct ArraysOf {
    using Row = typename Table::Row;
    static constexpr auto columns = []<std::size_t... k>(std::index_sequence<k...>) {
        return std::tuple{std::get<n_counting + k>(Table::columns)...};
    }
    (std::make_index_sequence<logs::n_columns<Table> - n_counting>{});
};
using RawArrays = ArraysOf<logs::RawTable, 1>;
using AngleArrays = ArraysOf<logs::AngleTable, 2>;

template <class T> using Values = std::vector<T>;
template <class T> using View = std::span<const T>;

// Collects rows; the arrays of `take_out` are its own memory.
template <class Arrays> class Collector {
public:
    void reserve(std::size_t rows) {
        logs::for_each_column<Arrays>(values_,
                                      [rows](const auto&, auto& values, std::size_t) { values.reserve(rows); });
    }
    [[nodiscard]] std::size_t size() const { return std::get<0>(values_).size(); }
    void add(const typename Arrays::Row& row) {
        logs::for_each_column<Arrays>(
            values_, [&row](const auto& column, auto& values, std::size_t) { values.push_back(column.of(row)); });
    }
    [[nodiscard]] py::dict take_out() {
        py::dict arrays;
        logs::for_each_column<Arrays>(values_, [&]<class Column>(const Column& column, auto& values, std::size_t) {
            if constexpr (std::is_same_v<typename Column::Rule, logs::Flag>)
                arrays[column.name] = as_bools(std::move(values));
            else
                arrays[column.name] = as_array(std::move(values));
        });
        return arrays;
    }

private:
    logs::PartsOf<Arrays, Values> values_;
};

// Collects half-periods.
class RawCollector : Collector<RawArrays> {
public:
    using Collector::reserve;
    using Collector::size;
    void add(const core::HalfRecord& record, const core::LightSamples& light = {});
    [[nodiscard]] py::dict take_out();

private:
    std::vector<float> light_a_, light_b_;
    bool has_fringe_ = false;  // in one half at least
};

// Collects the rows of an angle log.
class AngleCollector : Collector<AngleArrays> {
public:
    using Collector::reserve;
    using Collector::size;
    void add(const core::AngleRow& row) { Collector::add({.row = row}); }
    void add(const core::AngleRow& row, double true_arcsec);
    [[nodiscard]] py::dict take_out();

private:
    std::vector<double> truth_;
};

// Which columns a raw log has; its settings stay empty.
[[nodiscard]] logs::RawHeader header_of(const py::dict& columns, double timer_hz);

// The columns of a log as Python holds them, to be read where the interpreter is released.
template <class Arrays> class LogView {
public:
    // errors  ValueError: a column is missing or of another length; whole numbers that no reader would accept.
    explicit LogView(const py::dict& columns);

    [[nodiscard]] std::size_t size() const { return std::get<0>(values_).size(); }

protected:
    // Without the number of the row.
    [[nodiscard]] typename Arrays::Row row(std::size_t k) const {
        typename Arrays::Row row;
        logs::for_each_column<Arrays>(values_, [&row, k](const auto& column, const auto& values, std::size_t) {
            column.set(row, values.empty() ? column.absent : values[k]);
        });
        return row;
    }

    // Empty where there is no such column. errors  ValueError.
    template <class T> std::span<const T> hold(const py::dict& columns, const char* name);

    std::vector<py::object> held_;

private:
    logs::PartsOf<Arrays, View> values_;
};

class RawView : public LogView<RawArrays> {
public:
    // errors  ValueError: as above; rows that may not follow each other; light of another shape.
    explicit RawView(const py::dict& columns);

    [[nodiscard]] core::HalfRecord record(std::size_t row) const;
    [[nodiscard]] core::LightSamples light(std::size_t row) const;
    [[nodiscard]] int light_samples() const { return static_cast<int>(n_light_); }
    [[nodiscard]] bool has_light_b() const { return !light_b_.empty(); }

private:
    std::span<const float> hold_light(const py::dict& columns, const char* name);

    std::span<const float> light_a_, light_b_;
    std::size_t n_light_ = 0;
};

class AngleView : public LogView<AngleArrays> {
public:
    explicit AngleView(const py::dict& columns);

    [[nodiscard]] core::AngleRow angle(std::size_t row) const;
    [[nodiscard]] bool has_truth() const { return !truth_.empty(); }
    [[nodiscard]] double truth_arcsec(std::size_t row) const { return truth_.empty() ? 0.0 : truth_[row]; }

private:
    std::span<const double> truth_;
};

}  // namespace zlg::python
