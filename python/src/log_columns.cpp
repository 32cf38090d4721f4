#include "log_columns.hpp"

#include <zlg/logs/row_rules.hpp>

namespace zlg::python {

namespace {

bool has(const py::dict& columns, const char* name) { return columns.contains(name) && !columns[name].is_none(); }

}  // namespace

void RawCollector::add(const core::HalfRecord& record, const core::LightSamples& light) {
    Collector::add(record);
    has_fringe_ = has_fringe_ || core::has_fringe(record);
    light_a_.insert(light_a_.end(), light.a.begin(), light.a.end());
    light_b_.insert(light_b_.end(), light.b.begin(), light.b.end());
}

py::dict RawCollector::take_out() {
    const auto rows = static_cast<py::ssize_t>(size());
    const auto light = [rows](std::vector<float>&& samples) -> py::object {
        if (samples.empty() || rows == 0) return py::none();
        const auto wide = static_cast<py::ssize_t>(samples.size()) / rows;
        return as_array(std::move(samples), {rows, wide});
    };
    py::dict columns = Collector::take_out();
    if (!has_fringe_) columns["fringe"] = py::none();
    columns["light_a"] = light(std::move(light_a_));
    columns["light_b"] = light(std::move(light_b_));
    return columns;
}

void AngleCollector::add(const core::AngleRow& row, double true_arcsec) {
    add(row);
    truth_.push_back(true_arcsec);
}

py::dict AngleCollector::take_out() {
    py::dict columns = Collector::take_out();
    columns["truth_dtheta_arcsec"] = truth_.empty() ? py::object{py::none()} : as_array(std::move(truth_));
    return columns;
}

logs::RawHeader header_of(const py::dict& columns, double timer_hz) {
    logs::RawHeader header;
    logs::for_each_column<RawArrays>([&]<class Column>(const Column& column, std::size_t) {
        if constexpr (Column::is_optional) header.*column.is_there = has(columns, column.name);
    });
    header.has_valid = true;  // without the column every half is
    header.timer_hz = timer_hz;
    header.light_samples = has(columns, "light_a") ? 1 : 0;
    return header;
}

template <class Arrays>
template <class T>
std::span<const T> LogView<Arrays>::hold(const py::dict& columns, const char* name) {
    if (!has(columns, name)) return {};
    const py::object given = columns[name];
    In<T> array;
    if constexpr (std::is_integral_v<T>) {
        array = whole_numbers<T>(given, name);
    } else {
        array = In<T>{given};
    }
    held_.push_back(array);
    const auto values = span_of(array, name);
    if (held_.size() > 1 && values.size() != size())
        throw std::invalid_argument{std::string{name} + ": holds " + std::to_string(values.size()) +
                                    " rows; allowed are those of " + std::get<0>(Arrays::columns).name + ", " +
                                    std::to_string(size())};
    return values;
}

template <class Arrays> LogView<Arrays>::LogView(const py::dict& columns) {
    logs::for_each_column<Arrays>(values_, [&]<class Column>(const Column& column, auto& values, std::size_t) {
        using Value = typename Column::Value;
        if (!Column::is_optional && !has(columns, column.name))
            throw std::invalid_argument{std::string{column.name} + ": is missing; a log needs the column"};
        values = hold<Value>(columns, column.name);
        if constexpr (std::is_integral_v<Value>)
            refuse(values, column.name, column.rule.allowed().c_str(),
                   [&](std::size_t k) { return column.rule.allows(values[k], static_cast<std::int64_t>(k)); });
    });
}

std::span<const float> RawView::hold_light(const py::dict& columns, const char* name) {
    if (!has(columns, name)) return {};
    const In<float> array{columns[name]};
    if (array.ndim() != 2 || static_cast<std::size_t>(array.shape(0)) != size() ||
        array.shape(1) > core::max_light_samples)
        throw std::invalid_argument{std::string{name} + ": allowed is one row per half-period of up to 64 samples"};
    n_light_ = static_cast<std::size_t>(array.shape(1));
    held_.push_back(array);
    return {array.data(), static_cast<std::size_t>(array.size())};
}

RawView::RawView(const py::dict& columns) : LogView{columns} {
    logs::RawSequence rows;
    for (std::size_t k = 0; k < size(); ++k) {
        if (rows.next(record(k))) continue;
        const logs::RawSequence::Fault fault = rows.fault(record(k));
        throw std::invalid_argument{std::string{fault.column} + ": row " + std::to_string(k) + ": '" +
                                    std::to_string(fault.value) + "' " + fault.what};
    }
    light_a_ = hold_light(columns, "light_a");
    light_b_ = hold_light(columns, "light_b");
    if (has_light_b() && light_b_.size() != light_a_.size())
        throw std::invalid_argument{"light_b: allowed is the shape of light_a, or None"};
}

core::HalfRecord RawView::record(std::size_t row) const {
    core::HalfRecord record = LogView::row(row);
    record.half = static_cast<std::int64_t>(row);
    return record;
}

core::LightSamples RawView::light(std::size_t row) const {
    if (light_a_.empty()) return {};
    return {light_a_.subspan(row * n_light_, n_light_),
            light_b_.empty() ? std::span<const float>{} : light_b_.subspan(row * n_light_, n_light_)};
}

AngleView::AngleView(const py::dict& columns)
    : LogView{columns}, truth_{hold<double>(columns, "truth_dtheta_arcsec")} {}

core::AngleRow AngleView::angle(std::size_t row) const {
    core::AngleRow angle = LogView::row(row).row;
    angle.tick = static_cast<std::int64_t>(row);
    return angle;
}

}  // namespace zlg::python
