#include "log_columns.hpp"

namespace zlg::python {

void RawCollector::reserve(std::size_t halves) {
    half_.reserve(halves), counts_.reserve(halves), bias_sign_.reserve(halves), mode_.reserve(halves);
    loop_closed_.reserve(halves), valid_.reserve(halves), detuning_.reserve(halves), detuning_sq_.reserve(halves);
    piezo_.reserve(halves), temperature_.reserve(halves), edge_offset_.reserve(halves), span_.reserve(halves);
}

void RawCollector::add(const core::HalfRecord& r, const core::LightSamples& light) {
    half_.push_back(r.half);
    counts_.push_back(r.counts);
    bias_sign_.push_back(r.bias_sign);
    mode_.push_back(r.mode);
    loop_closed_.push_back(r.loop_closed ? 1 : 0);
    valid_.push_back(r.valid ? 1 : 0);
    detuning_.push_back(r.detuning_lambda);
    detuning_sq_.push_back(r.detuning_sq_lambda2);
    piezo_.push_back(r.piezo_v);
    temperature_.push_back(r.temperature_c);
    edge_offset_.push_back(r.edge_offset_ticks);
    span_.push_back(r.span);
    light_a_.insert(light_a_.end(), light.a.begin(), light.a.end());
    light_b_.insert(light_b_.end(), light.b.begin(), light.b.end());
}

py::dict RawCollector::take_out() {
    const auto rows = static_cast<py::ssize_t>(half_.size());
    const auto light = [rows](std::vector<float>&& samples) -> py::object {
        if (samples.empty() || rows == 0) return py::none();
        const auto wide = static_cast<py::ssize_t>(samples.size()) / rows;
        return as_array(std::move(samples), {rows, wide});
    };
    py::dict columns;
    columns["half"] = as_array(std::move(half_));
    columns["bias_sign"] = as_array(std::move(bias_sign_));
    columns["mode"] = as_array(std::move(mode_));
    columns["counts"] = as_array(std::move(counts_));
    columns["loop_closed"] = as_bools(std::move(loop_closed_));
    columns["valid"] = as_bools(std::move(valid_));
    columns["detuning_lambda"] = as_array(std::move(detuning_));
    columns["detuning_sq_lambda2"] = as_array(std::move(detuning_sq_));
    columns["piezo_v"] = as_array(std::move(piezo_));
    columns["temperature_c"] = as_array(std::move(temperature_));
    columns["edge_offset_ticks"] = as_array(std::move(edge_offset_));
    columns["span"] = as_array(std::move(span_));
    columns["light_a"] = light(std::move(light_a_));
    columns["light_b"] = light(std::move(light_b_));
    return columns;
}

logs::RawHeader header_of(const py::dict& columns, double timer_hz) {
    const auto has = [&](const char* name) { return columns.contains(name) && !columns[name].is_none(); };
    logs::RawHeader header;
    header.has_valid = true;
    header.has_detuning = has("detuning_lambda");
    header.has_detuning_sq = has("detuning_sq_lambda2");
    header.has_piezo = has("piezo_v");
    header.has_temperature = has("temperature_c");
    header.has_edge_offset = has("edge_offset_ticks");
    header.timer_hz = timer_hz;
    header.has_span = has("span");
    header.light_samples = has("light_a") ? 1 : 0;
    return header;
}

template <class T>
std::span<const T> RawView::hold(const py::dict& columns, const char* name) {
    if (!columns.contains(name) || columns[name].is_none()) return {};
    const py::object given = columns[name];
    In<T> array;
    if constexpr (std::is_integral_v<T>) {
        array = whole_numbers<T>(given, name);
    } else {
        array = In<T>{given};
    }
    held_.push_back(array);
    const auto values = span_of(array, name);
    if (counts_.data() != nullptr && values.size() != counts_.size())
        throw std::invalid_argument{std::string{name} + ": holds " + std::to_string(values.size()) +
                                    " rows; allowed are those of counts, " + std::to_string(counts_.size())};
    return values;
}

std::span<const float> RawView::hold_light(const py::dict& columns, const char* name) {
    if (!columns.contains(name) || columns[name].is_none()) return {};
    const In<float> array{columns[name]};
    if (array.ndim() != 2 || static_cast<std::size_t>(array.shape(0)) != counts_.size() ||
        array.shape(1) > core::max_light_samples)
        throw std::invalid_argument{std::string{name} + ": allowed is one row per half-period of up to 64 samples"};
    n_light_ = static_cast<std::size_t>(array.shape(1));
    held_.push_back(array);
    return {array.data(), static_cast<std::size_t>(array.size())};
}

RawView::RawView(const py::dict& columns) {
    counts_ = hold<std::int64_t>(columns, "counts");
    bias_sign_ = hold<std::int8_t>(columns, "bias_sign");
    mode_ = hold<std::int8_t>(columns, "mode");
    loop_closed_ = hold<std::uint8_t>(columns, "loop_closed");
    if (bias_sign_.size() != size() || mode_.size() != size() || loop_closed_.size() != size())
        throw std::invalid_argument{"a raw log has counts, bias_sign, mode and loop_closed, of one length"};
    valid_ = hold<std::uint8_t>(columns, "valid");
    refuse_bad_rows();
    detuning_ = hold<double>(columns, "detuning_lambda");
    detuning_sq_ = hold<double>(columns, "detuning_sq_lambda2");
    piezo_ = hold<double>(columns, "piezo_v");
    temperature_ = hold<double>(columns, "temperature_c");
    edge_offset_ = hold<std::int32_t>(columns, "edge_offset_ticks");
    span_ = hold<std::int32_t>(columns, "span");
    refuse_bad_spans();
    light_a_ = hold_light(columns, "light_a");
    light_b_ = hold_light(columns, "light_b");
    if (has_light_b() && light_b_.size() != light_a_.size())
        throw std::invalid_argument{"light_b: allowed is the shape of light_a, or None"};
}

// The rules of the readers.
void RawView::refuse_bad_rows() const {
    constexpr std::int64_t most = std::int64_t{1} << 52;
    const auto is_sign = [](int value) { return value == 1 || value == -1; };
    refuse(counts_, "counts", "-2^52..2^52", [&](std::size_t k) { return -most <= counts_[k] && counts_[k] <= most; });
    refuse(mode_, "mode", "1 or -1", [&](std::size_t k) { return is_sign(mode_[k]); });
    refuse(bias_sign_, "bias_sign", "1 and -1 in turn",
           [&](std::size_t k) { return is_sign(bias_sign_[k]) && (k == 0 || bias_sign_[k] != bias_sign_[k - 1]); });
    refuse(loop_closed_, "loop_closed", "0 or 1", [&](std::size_t k) { return loop_closed_[k] <= 1; });
    refuse(valid_, "valid", "0 or 1", [&](std::size_t k) { return valid_[k] <= 1; });
}

void RawView::refuse_bad_spans() const {
    std::int64_t missed = 0;
    refuse(span_, "span", "1 and one for each row of valid 0, counts 0, span 1 directly before", [&](std::size_t k) {
        if (span_[k] < 1 || span_[k] - 1 > missed) return false;
        const bool is_missed = !valid_.empty() && valid_[k] == 0 && counts_[k] == 0 && span_[k] == 1;
        missed = is_missed ? missed + 1 : 0;
        return true;
    });
}

core::HalfRecord RawView::record(std::size_t row) const {
    const auto of = [row](std::span<const double> column) {
        return column.empty() ? std::numeric_limits<double>::quiet_NaN() : column[row];
    };
    return {.half = static_cast<std::int64_t>(row),
            .counts = counts_[row],
            .detuning_lambda = of(detuning_),
            .detuning_sq_lambda2 = of(detuning_sq_),
            .piezo_v = of(piezo_),
            .temperature_c = of(temperature_),
            .bias_sign = bias_sign_[row],
            .mode = mode_[row],
            .loop_closed = loop_closed_[row] != 0,
            .valid = valid_.empty() || valid_[row] != 0,
            .edge_offset_ticks = edge_offset_.empty() ? 0 : edge_offset_[row],
            .span = span_.empty() ? 1 : span_[row]};
}

core::LightSamples RawView::light(std::size_t row) const {
    if (light_a_.empty()) return {};
    return {light_a_.subspan(row * n_light_, n_light_),
            light_b_.empty() ? std::span<const float>{} : light_b_.subspan(row * n_light_, n_light_)};
}

void AngleCollector::reserve(std::size_t ticks) {
    tick_.reserve(ticks), dtheta_.reserve(ticks), final_.reserve(ticks), sigma_.reserve(ticks);
    mode_.reserve(ticks), flags_.reserve(ticks);
}

void AngleCollector::add(const core::AngleRow& row) {
    tick_.push_back(row.tick);
    dtheta_.push_back(row.dtheta_arcsec);
    final_.push_back(row.dtheta_final_arcsec);
    sigma_.push_back(row.sigma_arcsec);
    mode_.push_back(row.mode);
    flags_.push_back(row.flags);
}

void AngleCollector::add(const core::AngleRow& row, double true_arcsec) {
    add(row);
    truth_.push_back(true_arcsec);
}

py::dict AngleCollector::take_out() {
    py::dict columns;
    columns["tick"] = as_array(std::move(tick_));
    columns["dtheta_arcsec"] = as_array(std::move(dtheta_));
    columns["dtheta_final_arcsec"] = as_array(std::move(final_));
    columns["sigma_arcsec"] = as_array(std::move(sigma_));
    columns["mode"] = as_array(std::move(mode_));
    columns["flags"] = as_array(std::move(flags_));
    columns["truth_dtheta_arcsec"] = truth_.empty() ? py::object{py::none()} : as_array(std::move(truth_));
    return columns;
}

}  // namespace zlg::python
