#include <zlg/calibration/rate_table.hpp>
#include <zlg/noise/imu_yaml.hpp>
#include <zlg/noise/mode_split.hpp>
#include <zlg/noise/noise_fit.hpp>
#include <zlg/noise/noise_units.hpp>
#include <zlg/noise/spectrum.hpp>

#include "analysis_dicts.hpp"
#include "bind.hpp"
#include "fields_dict.hpp"

BOOST_HANA_ADAPT_STRUCT(zlg::noise::NoiseTerms, quantisation_arcsec, angle_random_walk_arcsec_sqrt_s, filter_time_s,
                        bias_instability_arcsec_s, rate_random_walk_arcsec_s_sqrt_s, ramp_arcsec_s2);

namespace zlg::python {

py::dict dict_of(const noise::ModeSplit& split) {
    py::dict d;
    add_columns(d, split.segments, "segment_");
    add_columns(d, split.points);
    add_columns(d, split.switches, "switch_");
    d["nonmagnetic"] = value_object(split.nonmagnetic_arcsec_s);
    d["magnetic"] = value_object(split.magnetic_arcsec_s);
    d["magnetic_thermal"] = value_object(split.magnetic_thermal_arcsec_s);
    d["thermal_time"] = value_object(split.thermal_time_s);
    d["switch_rms_arcsec"] = split.statistics.rms_arcsec;
    return d;
}

namespace {

using Pairs = std::vector<std::pair<double, double>>;

py::dict terms_dict(const noise::NoiseTerms& terms) {
    Pairs markov, sines;
    for (const noise::MarkovNoise& each : terms.markov) markov.emplace_back(each.deviation_arcsec_s, each.time_s);
    for (const noise::SineTerm& each : terms.sines) sines.emplace_back(each.amplitude_arcsec_s, each.frequency_hz);
    py::dict d = fields_dict(terms);
    d["markov"] = markov;
    d["sines"] = sines;
    return d;
}

}  // namespace

py::dict dict_of(const noise::NoiseFit& fit) {
    py::list fitted;
    for (const noise::FittedTerm& term : fit.fitted) {
        py::dict t = fields_dict(term);
        t["name"] = name_of(term.kind);
        t["unit"] = unit_of(term.kind);
        t["second"] = term.second;
        t["second_sigma"] = term.second_sigma;
        fitted.append(t);
    }
    py::dict d = fields_dict(fit);
    d["terms"] = terms_dict(fit.terms);
    d["fitted"] = fitted;
    d["tau_s"] = column(fit.points, &noise::FitPoint::tau_s);
    d["measured"] = column(fit.points, &noise::FitPoint::measured);
    d["fitted_variance"] = column(fit.points, &noise::FitPoint::fitted);
    return d;
}

namespace {

using namespace calibration;
using namespace deviations;
using namespace noise;

py::dict fit(const Samples& samples, bool markov, int most_sines, double least_known_ratio, int threads) {
    const Series series = series_of(samples);
    return dict_of(without_interpreter([&] {
        return fit_noise(
            series,
            {.markov = markov, .most_sines = most_sines, .least_known_ratio = least_known_ratio, .threads = threads});
    }));
}

NoiseTerms terms_of(const py::object& given) {
    NoiseTerms terms;
    study::for_each_field<NoiseTerms>(
        [&](const char* name, auto get) { get(terms) = py::cast<double>(given.attr(name)); });
    for (const auto& [deviation, time] : py::cast<Pairs>(given.attr("markov")))
        terms.markov.push_back({deviation, time});
    for (const auto& [amplitude, frequency] : py::cast<Pairs>(given.attr("sines")))
        terms.sines.push_back({amplitude, frequency});
    return terms;
}

py::dict terms_of_sheet(double quantisation, double walk, double instability, double rate_walk, double ramp) {
    return terms_dict(noise::terms_of(DataSheet{quantisation, walk, instability, rate_walk, ramp}));
}

void bind_terms(py::module_& m) {
    m.def("allan_variance", [](const py::object& given, const In<double>& tau_s) {
        const NoiseTerms terms = terms_of(given);
        return of_each([&terms](double tau) { return allan_variance(terms, tau); }, tau_s);
    });
    m.def("rate_spectrum", [](const py::object& given, const In<double>& frequency_hz, double rate_hz) {
        const NoiseTerms terms = terms_of(given);
        return of_each([&](double f) { return rate_spectrum(terms, f, rate_hz); }, frequency_hz);
    });
    m.def("data_sheet", [](const py::object& terms) { return fields_dict(data_sheet(terms_of(terms))); });
    m.def("terms_of_sheet", &terms_of_sheet);
    m.def("discrete_noise", [](const py::object& terms, double rate_hz) {
        return fields_dict(discrete_noise(terms_of(terms), rate_hz));
    });
    m.def("imu_yaml",
          [](const py::object& terms, double rate_hz) { return imu_yaml(kalibr_gyro(terms_of(terms), rate_hz)); });
}

py::tuple spectrum(const In<double>& rates, double rate_hz, std::size_t piece, double least_known_ratio) {
    const auto values = span_of(rates, "rates_arcsec_s");
    Spectrum s = without_interpreter([&] { return welch_spectrum(values, rate_hz, piece, least_known_ratio); });
    return py::make_tuple(as_array(std::move(s.frequency_hz)), as_array(std::move(s.density)));
}

py::dict modes(const In<double>& rates, const In<std::int8_t>& mode, double rate_hz,
               const std::optional<In<double>>& bridged, std::int64_t settling) {
    const ModeRecord record{rate_hz, span_of(rates, "rates_arcsec_s"), span_of(bridged, "bridged_arcsec_s"),
                            span_of(mode, "mode")};
    return dict_of(without_interpreter([&] { return split_modes(record, settling); }));
}

py::dict table(const In<double>& input, const In<double>& output, std::int64_t settling, double earth_arcsec_s) {
    const RateTable t = rate_table(span_of(input, "input_arcsec_s"), span_of(output, "output"),
                                   {.settling_samples = settling, .earth_arcsec_s = earth_arcsec_s});
    py::dict d = fields_dict(t);
    add_columns(d, t.stages);
    return d;
}

}  // namespace

void bind_noise(py::module_& m) {
    bind_terms(m);
    m.def("fit_noise", &fit);
    m.def("welch_spectrum", &spectrum);
    m.def("split_modes", &modes);
    m.def("rate_table", &table);
}

}  // namespace zlg::python
