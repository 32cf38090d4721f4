#include <fmt/format.h>

#include <zlg/calibration/rate_table.hpp>
#include <zlg/noise/imu_yaml.hpp>
#include <zlg/noise/mode_split.hpp>
#include <zlg/noise/noise_fit.hpp>
#include <zlg/noise/noise_units.hpp>
#include <zlg/noise/spectrum.hpp>

#include "analysis_dicts.hpp"
#include "bind.hpp"
#include "fields_dict.hpp"

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
    d["terms"] = fit.terms;
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
    const Series series = samples.series();
    return dict_of(without_interpreter([&] {
        return fit_noise(
            series,
            {.markov = markov, .most_sines = most_sines, .least_known_ratio = least_known_ratio, .threads = threads});
    }));
}

using Pairs = std::vector<std::pair<double, double>>;

// A list of terms with two numbers each as pairs, which are read and assigned as a whole.
template <class Term>
void add_pairs(py::class_<NoiseTerms>& terms, const char* name, std::vector<Term> NoiseTerms::*member,
               double Term::*first, double Term::*second, const char* meaning) {
    terms.def_property(
        name,
        [=](const NoiseTerms& t) {
            Pairs pairs;
            for (const Term& each : t.*member) pairs.emplace_back(each.*first, each.*second);
            return pairs;
        },
        [=](NoiseTerms& t, const Pairs& pairs) {
            (t.*member).clear();
            for (const auto& [a, b] : pairs) (t.*member).push_back({a, b});
        },
        meaning);
}

// Those that are there.
std::string text_of(const NoiseTerms& t) {
    std::string text;
    const auto add = [&text](const char* name, double value) {
        if (value != 0.0) text += fmt::format("{}{}={:.6g}", text.empty() ? "" : ", ", name, value);
    };
    add("quantisation_arcsec", t.quantisation_arcsec);
    add("angle_random_walk_arcsec_sqrt_s", t.angle_random_walk_arcsec_sqrt_s);
    add("filter_time_s", t.filter_time_s);
    add("bias_instability_arcsec_s", t.bias_instability_arcsec_s);
    add("rate_random_walk_arcsec_s_sqrt_s", t.rate_random_walk_arcsec_s_sqrt_s);
    add("ramp_arcsec_s2", t.ramp_arcsec_s2);
    for (const MarkovNoise& each : t.markov)
        text +=
            fmt::format("{}markov=({:.6g}, {:.6g})", text.empty() ? "" : ", ", each.deviation_arcsec_s, each.time_s);
    for (const SineTerm& each : t.sines)
        text += fmt::format("{}sine=({:.6g}, {:.6g})", text.empty() ? "" : ", ", each.amplitude_arcsec_s,
                            each.frequency_hz);
    return fmt::format("NoiseTerms({})", text);
}

void bind_terms(py::module_& m) {
    py::class_<NoiseTerms> terms{m, "NoiseTerms", "The terms of a gyro's noise, arcsec and seconds; 0: absent."};
    add_pairs(terms, "markov", &NoiseTerms::markov, &MarkovNoise::deviation_arcsec_s, &MarkovNoise::time_s,
              "Pairs (deviation_arcsec_s, time_s); assign a whole list.");
    add_pairs(terms, "sines", &NoiseTerms::sines, &SineTerm::amplitude_arcsec_s, &SineTerm::frequency_hz,
              "Pairs (amplitude_arcsec_s, frequency_hz); assign a whole list.");
    terms.def(py::init<>())
        .def("__repr__", &text_of)
        .def_readwrite("quantisation_arcsec", &NoiseTerms::quantisation_arcsec)
        .def_readwrite("angle_random_walk_arcsec_sqrt_s", &NoiseTerms::angle_random_walk_arcsec_sqrt_s)
        .def_readwrite("filter_time_s", &NoiseTerms::filter_time_s)
        .def_readwrite("bias_instability_arcsec_s", &NoiseTerms::bias_instability_arcsec_s)
        .def_readwrite("rate_random_walk_arcsec_s_sqrt_s", &NoiseTerms::rate_random_walk_arcsec_s_sqrt_s)
        .def_readwrite("ramp_arcsec_s2", &NoiseTerms::ramp_arcsec_s2)
        .def(
            "allan_variance",
            [](const NoiseTerms& t, const In<double>& tau_s) {
                return of_each([&t](double tau) { return allan_variance(t, tau); }, tau_s);
            },
            "tau_s"_a, "Allan variance of the rate at tau_s, (arcsec/s)^2, shape of tau_s.")
        .def(
            "rate_spectrum",
            [](const NoiseTerms& t, const In<double>& frequency_hz, double rate_hz) {
                return of_each([&](double f) { return rate_spectrum(t, f, rate_hz); }, frequency_hz);
            },
            "frequency_hz"_a, "rate_hz"_a, "Two-sided spectrum of the rate, (arcsec/s)^2/Hz, shape of frequency_hz.");
}

void bind_units(py::module_& m) {
    m.def(
        "data_sheet", [](const NoiseTerms& terms) { return fields_dict(data_sheet(terms)); }, "terms"_a);
    m.def(
        "terms_of_sheet",
        [](double quantisation, double walk, double instability, double rate_walk, double ramp) {
            return terms_of(DataSheet{quantisation, walk, instability, rate_walk, ramp});
        },
        "quantisation_arcsec"_a, "angle_random_walk_deg_sqrt_h"_a, "bias_instability_deg_h"_a,
        "rate_random_walk_deg_h_sqrt_h"_a, "ramp_deg_h_h"_a);
    m.def(
        "discrete_noise",
        [](const NoiseTerms& terms, double rate_hz) { return fields_dict(discrete_noise(terms, rate_hz)); }, "terms"_a,
        "rate_hz"_a);
    m.def(
        "imu_yaml", [](const NoiseTerms& terms, double rate_hz) { return imu_yaml(kalibr_gyro(terms, rate_hz)); },
        "terms"_a, "rate_hz"_a);
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
    bind_units(m);
    m.def("fit_noise", &fit, "samples"_a, "markov"_a, "most_sines"_a, "least_known_ratio"_a, "threads"_a);
    m.def("welch_spectrum", &spectrum, "rates_arcsec_s"_a, "rate_hz"_a, "piece"_a, "least_known_ratio"_a);
    m.def("split_modes", &modes, "rates_arcsec_s"_a, "mode"_a, "rate_hz"_a, "bridged_arcsec_s"_a, "settling_samples"_a);
    m.def("rate_table", &table, "input_arcsec_s"_a, "output"_a, "settling_samples"_a, "earth_arcsec_s"_a);
}

}  // namespace zlg::python
