#include <cmath>

#include <zlg/deviations/angle_samples.hpp>
#include <zlg/deviations/averaging.hpp>
#include <zlg/deviations/deviation.hpp>
#include <zlg/deviations/deviation_stream.hpp>

#include "analysis_dicts.hpp"
#include "arrays.hpp"
#include "bind.hpp"

namespace zlg::python {

py::dict dict_of(const deviations::DeviationCurve& curve) {
    const auto& p = curve.points;
    py::dict c;
    c["kind"] = std::string{name_of(curve.kind)};
    c["confidence"] = curve.confidence;
    c["m"] = column(p, &deviations::DeviationPoint::m);
    c["tau_s"] = column(p, &deviations::DeviationPoint::tau_s);
    c["deviation"] = column(p, &deviations::DeviationPoint::deviation);
    c["low"] = column(p, &deviations::DeviationPoint::low);
    c["high"] = column(p, &deviations::DeviationPoint::high);
    c["terms"] = column(p, &deviations::DeviationPoint::terms);
    c["edf"] = column(p, [](const deviations::DeviationPoint& each) { return each.law.edf; });
    c["noise"] = column(p, &deviations::DeviationPoint::noise);
    c["as_computed"] = column(p, &deviations::DeviationPoint::as_computed);
    c["bias"] = std::string{name_of(curve.total_bias)};
    return c;
}

namespace {

using namespace deviations;

SeriesKind kind_of(const std::string& data_type, const std::string& unit, double rate_hz) {
    return {data_kind_of(data_type), unit_of(unit), rate_hz};
}

std::vector<std::int64_t> spaced(const std::string& taus, int per_decade, std::int64_t largest) {
    if (taus == "octave") return octave_factors(largest);
    if (taus == "decade") return decade_factors(largest);
    if (taus == "log") return log_factors(per_decade, largest);
    if (taus == "all") return all_factors(largest);
    throw SeriesError{"taus = \"" + taus + "\": allowed are octave, decade, log, all, or the times in seconds"};
}

// A tau of which the record has no term is left out.
std::vector<double> within(const std::vector<double>& taus_s, double rate_hz, std::int64_t largest) {
    std::vector<double> kept;
    for (const double tau_s : taus_s)
        if (!(std::round(tau_s * rate_hz) > static_cast<double>(largest))) kept.push_back(tau_s);
    return kept;
}

using Taus = std::variant<std::string, std::vector<double>>;

std::vector<std::int64_t> factors_of(const Taus& taus, int per_decade, bool drop_long_taus, double rate_hz,
                                     std::int64_t largest) {
    if (const auto* name = std::get_if<std::string>(&taus)) return spaced(*name, per_decade, largest);
    const auto& given = std::get<std::vector<double>>(taus);
    return nearest_factors(drop_long_taus ? within(given, rate_hz, largest) : given, rate_hz, largest);
}

py::dict deviation_of(const std::string& kind, const In<double>& values, double rate_hz, const std::string& data_type,
                      const std::string& unit, const std::optional<In<std::uint8_t>>& valid, const Taus& taus,
                      int per_decade, bool drop_long_taus, const DeviationOptions& options) {
    const DeviationKind which = deviation_kind_of(kind);
    const Series series{kind_of(data_type, unit, rate_hz), span_of(values, "data"), span_of(valid, "valid")};
    DeviationCurve curve;
    {
        const py::gil_scoped_release released;
        const AngleRecord record{series};
        const auto largest = largest_factor(which, record.n_intervals());
        curve = deviation(record, which, factors_of(taus, per_decade, drop_long_taus, rate_hz, largest), options);
    }
    return dict_of(curve);
}

StreamConfig stream_config(const SeriesKind& what, const std::vector<std::string>& kinds,
                           const std::vector<std::int64_t>& factors, std::int64_t window, double least_known_ratio) {
    StreamConfig config{
        .what = what, .kinds = {}, .factors = factors, .window = window, .least_known_ratio = least_known_ratio};
    for (const std::string& kind : kinds) config.kinds.push_back(deviation_kind_of(kind));
    return config;
}

// An angle log through a stream: memory does not grow with the log.
DeviationStream stream_of_log(const std::string& path, const std::vector<std::string>& kinds,
                              const std::vector<std::int64_t>& factors, std::int64_t window, double least_known_ratio,
                              bool final_angles) {
    const AngleSamples samples =
        angle_samples(path, final_angles ? logs::AngleColumn::dtheta_final : logs::AngleColumn::dtheta);
    DeviationStream stream{stream_config(samples.what, kinds, factors, window, least_known_ratio)};
    read_into(stream, [&](std::span<double> values, std::span<std::uint8_t> valid) {
        look_for_signals();
        return samples.source(values, valid);
    });
    return stream;
}

void bind_stream(py::module_& m) {
    py::class_<DeviationStream>(m, "DeviationStream")
        .def(py::init([](double rate_hz, const std::string& data_type, const std::string& unit,
                         const std::vector<std::string>& kinds, const std::vector<std::int64_t>& factors,
                         std::int64_t window, double least_known_ratio) {
                 return DeviationStream{
                     stream_config(kind_of(data_type, unit, rate_hz), kinds, factors, window, least_known_ratio)};
             }),
             py::arg("rate_hz"), py::arg("data_type"), py::arg("unit"), py::arg("kinds"), py::arg("factors"),
             py::arg("window"), py::arg("least_known_ratio"))
        .def_static("of_log", &stream_of_log, py::call_guard<py::gil_scoped_release>(), py::arg("path"),
                    py::arg("kinds"), py::arg("factors"), py::arg("window"), py::arg("least_known_ratio"),
                    py::arg("final_angles"))
        // Not without the interpreter: another thread may read the curve meanwhile.
        .def(
            "add",
            [](DeviationStream& stream, const In<double>& values, const std::optional<In<std::uint8_t>>& valid) {
                stream.add(span_of(values, "data"), span_of(valid, "valid"));
            },
            py::arg("values"), py::arg("valid"))
        .def(
            "curve",
            [](const DeviationStream& stream, const std::string& kind, double confidence, std::optional<int> noise) {
                return dict_of(stream.curve(deviation_kind_of(kind), {.confidence = confidence, .noise = noise}));
            },
            py::arg("kind"), py::arg("confidence"), py::arg("noise"))
        .def_property_readonly("n_samples", &DeviationStream::n_samples)
        .def_property_readonly("n_known", &DeviationStream::n_known)
        .def_property_readonly("memory_bytes", &DeviationStream::memory_bytes);
}

}  // namespace

void bind_deviations(py::module_& m) {
    m.def(
        "deviation",
        [](const std::string& kind, const In<double>& values, double rate_hz, const std::string& data_type,
           const std::string& unit, const std::optional<In<std::uint8_t>>& valid, const Taus& taus, int per_decade,
           bool drop_long_taus, double confidence, double least_known_ratio, std::optional<int> noise,
           const std::string& bias, int threads) {
            const DeviationOptions options{.confidence = confidence,
                                           .least_known_ratio = least_known_ratio,
                                           .noise = noise,
                                           .total_bias = total_bias_of(bias),
                                           .threads = threads};
            return deviation_of(kind, values, rate_hz, data_type, unit, valid, taus, per_decade, drop_long_taus,
                                options);
        },
        py::arg("kind"), py::arg("values"), py::arg("rate_hz"), py::arg("data_type"), py::arg("unit"), py::arg("valid"),
        py::arg("taus"), py::arg("per_decade"), py::arg("drop_long_taus"), py::arg("confidence"),
        py::arg("least_known_ratio"), py::arg("noise"), py::arg("bias"), py::arg("threads"));
    m.attr("not_measured") = not_measured;
    bind_stream(m);
}

}  // namespace zlg::python
