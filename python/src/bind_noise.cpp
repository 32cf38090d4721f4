#include <zlg/calibration/rate_table.hpp>
#include <zlg/noise/imu_yaml.hpp>
#include <zlg/noise/mode_split.hpp>
#include <zlg/noise/noise_fit.hpp>
#include <zlg/noise/noise_units.hpp>
#include <zlg/noise/spectrum.hpp>

#include "analysis_dicts.hpp"
#include "arrays.hpp"
#include "bind.hpp"

namespace zlg::python {
namespace {

py::list fitted(const noise::NoiseFit& fit) {
    py::list all;
    for (const noise::FittedTerm& term : fit.fitted) {
        py::dict t;
        t["name"] = std::string{name_of(term.kind)};
        t["unit"] = std::string{unit_of(term.kind)};
        t["found"] = term.found;
        t["value"] = term.value;
        t["sigma"] = term.sigma;
        t["second"] = term.second;
        t["second_sigma"] = term.second_sigma;
        t["limit"] = term.limit;
        t["read_at_s"] = term.read_at_s;
        all.append(t);
    }
    return all;
}

py::object of(const numeric::Estimate& e) {
    return e.determined ? py::object{py::make_tuple(e.value, e.sigma)} : py::object{py::none()};
}

}  // namespace

py::dict dict_of(const noise::ModeSplit& split) {
    using namespace noise;
    py::dict d;
    d["segment_time_s"] = column(split.segments, &ModeSegment::time_s);
    d["segment_mode"] = column(split.segments, &ModeSegment::mode);
    d["segment_rate_arcsec_s"] = column(split.segments, &ModeSegment::rate_arcsec_s);
    d["time_s"] = column(split.points, &ModePoint::time_s);
    d["magnetic_arcsec_s"] = column(split.points, &ModePoint::magnetic_arcsec_s);
    d["nonmagnetic_arcsec_s"] = column(split.points, &ModePoint::nonmagnetic_arcsec_s);
    d["nonmagnetic"] = of(split.nonmagnetic_arcsec_s);
    d["magnetic"] = of(split.magnetic_arcsec_s);
    d["magnetic_thermal"] = of(split.magnetic_thermal_arcsec_s);
    d["thermal_time"] = of(split.thermal_time_s);
    d["switch_time_s"] = column(split.switches, &SwitchAngle::time_s);
    d["switch_mode_after"] = column(split.switches, &SwitchAngle::mode_after);
    d["switch_error_arcsec"] = column(split.switches, &SwitchAngle::error_arcsec);
    d["switch_rms_arcsec"] = split.statistics.rms_arcsec;
    return d;
}

py::dict dict_of(const noise::NoiseFit& fit) {
    py::dict d;
    d["terms"] = fit.terms;
    d["fitted"] = fitted(fit);
    d["tau_s"] = column(fit.points, &noise::FitPoint::tau_s);
    d["measured"] = column(fit.points, &noise::FitPoint::measured);
    d["fitted_variance"] = column(fit.points, &noise::FitPoint::fitted);
    d["chi2"] = fit.chi2;
    d["dof"] = fit.dof;
    d["probability"] = fit.probability;
    d["model_error"] = fit.model_error;
    d["describes"] = fit.describes;
    return d;
}

namespace {

using namespace calibration;
using namespace deviations;
using namespace noise;

py::dict fit(const In<double>& values, double rate_hz, const std::string& data_type, const std::string& unit,
             const std::optional<In<std::uint8_t>>& valid, bool markov, int most_sines, double least_known_ratio,
             int threads) {
    const Series series{
        {data_kind_of(data_type), unit_of(unit), rate_hz}, span_of(values, "data"), span_of(valid, "valid")};
    NoiseFit found;
    {
        const py::gil_scoped_release released;
        found = fit_noise(
            series,
            {.markov = markov, .most_sines = most_sines, .least_known_ratio = least_known_ratio, .threads = threads});
    }
    return dict_of(found);
}

using Pairs = std::vector<std::pair<double, double>>;

void bind_terms(py::module_& m) {
    py::class_<NoiseTerms>(m, "NoiseTerms", "The terms of a gyro's noise, arcsec and seconds; 0: absent.")
        .def(py::init<>())
        .def_readwrite("quantisation_arcsec", &NoiseTerms::quantisation_arcsec)
        .def_readwrite("angle_random_walk_arcsec_sqrt_s", &NoiseTerms::angle_random_walk_arcsec_sqrt_s)
        .def_readwrite("bias_instability_arcsec_s", &NoiseTerms::bias_instability_arcsec_s)
        .def_readwrite("rate_random_walk_arcsec_s_sqrt_s", &NoiseTerms::rate_random_walk_arcsec_s_sqrt_s)
        .def_readwrite("ramp_arcsec_s2", &NoiseTerms::ramp_arcsec_s2)
        .def_property(
            "markov",
            [](const NoiseTerms& t) {
                Pairs pairs;
                for (const MarkovNoise& each : t.markov) pairs.emplace_back(each.deviation_arcsec_s, each.time_s);
                return pairs;
            },
            [](NoiseTerms& t, const Pairs& pairs) {
                t.markov.clear();
                for (const auto& [deviation, time] : pairs) t.markov.push_back({deviation, time});
            },
            "Pairs (deviation_arcsec_s, time_s); assign a whole list.")
        .def_property(
            "sines",
            [](const NoiseTerms& t) {
                Pairs pairs;
                for (const SineTerm& each : t.sines) pairs.emplace_back(each.amplitude_arcsec_s, each.frequency_hz);
                return pairs;
            },
            [](NoiseTerms& t, const Pairs& pairs) {
                t.sines.clear();
                for (const auto& [amplitude, frequency] : pairs) t.sines.push_back({amplitude, frequency});
            },
            "Pairs (amplitude_arcsec_s, frequency_hz); assign a whole list.")
        .def(
            "allan_variance",
            [](const NoiseTerms& t, const In<double>& tau_s) {
                return of_each([&t](double tau) { return allan_variance(t, tau); }, tau_s);
            },
            py::arg("tau_s"), "Allan variance of the rate at tau_s, (arcsec/s)^2, shape of tau_s.")
        .def(
            "rate_spectrum",
            [](const NoiseTerms& t, const In<double>& frequency_hz, double rate_hz) {
                return of_each([&](double f) { return rate_spectrum(t, f, rate_hz); }, frequency_hz);
            },
            py::arg("frequency_hz"), py::arg("rate_hz"),
            "Two-sided spectrum of the rate, (arcsec/s)^2/Hz, shape of frequency_hz.");
}

py::dict sheet_of(const NoiseTerms& terms) {
    const DataSheet sheet = data_sheet(terms);
    py::dict d;
    d["quantisation_arcsec"] = sheet.quantisation_arcsec;
    d["angle_random_walk_deg_sqrt_h"] = sheet.angle_random_walk_deg_sqrt_h;
    d["bias_instability_deg_h"] = sheet.bias_instability_deg_h;
    d["rate_random_walk_deg_h_sqrt_h"] = sheet.rate_random_walk_deg_h_sqrt_h;
    d["ramp_deg_h_h"] = sheet.ramp_deg_h_h;
    return d;
}

py::dict discrete(const NoiseTerms& terms, double rate_hz) {
    const DiscreteNoise n = discrete_noise(terms, rate_hz);
    py::dict d;
    d["white_rate_arcsec_s"] = n.white_rate_arcsec_s;
    d["white_increment_arcsec"] = n.white_increment_arcsec;
    d["walk_step_arcsec_s"] = n.walk_step_arcsec_s;
    d["angle_error_arcsec"] = n.angle_error_arcsec;
    d["ramp_step_arcsec_s"] = n.ramp_step_arcsec_s;
    d["markov_factor"] = n.markov_factor;
    d["markov_step_arcsec_s"] = n.markov_step_arcsec_s;
    return d;
}

void bind_units(py::module_& m) {
    m.def("data_sheet", &sheet_of, py::arg("terms"));
    m.def(
        "terms_of_sheet",
        [](double quantisation, double walk, double instability, double rate_walk, double ramp) {
            return terms_of(DataSheet{quantisation, walk, instability, rate_walk, ramp});
        },
        py::arg("quantisation_arcsec"), py::arg("angle_random_walk_deg_sqrt_h"), py::arg("bias_instability_deg_h"),
        py::arg("rate_random_walk_deg_h_sqrt_h"), py::arg("ramp_deg_h_h"));
    m.def("discrete_noise", &discrete, py::arg("terms"), py::arg("rate_hz"));
    m.def(
        "read_imu_yaml",
        [](const std::string& path) {
            const KalibrGyro gyro = read_imu_yaml(path);
            return std::pair{terms_of(gyro), gyro.update_rate_hz};
        },
        py::arg("path"));
    m.def(
        "imu_yaml", [](const NoiseTerms& terms, double rate_hz) { return imu_yaml(kalibr_gyro(terms, rate_hz)); },
        py::arg("terms"), py::arg("rate_hz"));
}

py::tuple spectrum(const In<double>& rates, double rate_hz, std::size_t piece, double least_known_ratio) {
    const auto values = span_of(rates, "rates_arcsec_s");
    Spectrum s;
    {
        const py::gil_scoped_release released;
        s = welch_spectrum(values, rate_hz, piece, least_known_ratio);
    }
    return py::make_tuple(as_array(std::move(s.frequency_hz)), as_array(std::move(s.density)));
}

py::tuple spectrogram_of(const In<double>& rates, double rate_hz, std::size_t piece, double least_known_ratio) {
    const auto values = span_of(rates, "rates_arcsec_s");
    Spectrogram s;
    {
        const py::gil_scoped_release released;
        s = spectrogram(values, rate_hz, piece, least_known_ratio);
    }
    const auto times = static_cast<py::ssize_t>(s.time_s.size());
    const auto frequencies = static_cast<py::ssize_t>(s.frequency_hz.size());
    return py::make_tuple(as_array(std::move(s.time_s)), as_array(std::move(s.frequency_hz)),
                          as_array(std::move(s.density), {times, frequencies}));
}

py::dict modes(const In<double>& rates, const In<std::int8_t>& mode, double rate_hz,
               const std::optional<In<double>>& bridged, std::int64_t settling) {
    const ModeRecord record{rate_hz, span_of(rates, "rates_arcsec_s"), span_of(bridged, "bridged_arcsec_s"),
                            span_of(mode, "mode")};
    ModeSplit split;
    {
        const py::gil_scoped_release released;
        split = split_modes(record, settling);
    }
    return dict_of(split);
}

py::dict table(const In<double>& input, const In<double>& output, std::int64_t settling, double earth_arcsec_s) {
    const RateTable t = rate_table(span_of(input, "input_arcsec_s"), span_of(output, "output"),
                                   {.settling_samples = settling, .earth_arcsec_s = earth_arcsec_s});
    py::dict d;
    d["input_arcsec_s"] = column(t.stages, &TableStage::input_arcsec_s);
    d["output"] = column(t.stages, &TableStage::output);
    d["residual_ppm"] = column(t.stages, &TableStage::residual_ppm);
    d["scale_factor"] = of(t.scale_factor);
    d["arcsec_per_unit"] = of(t.arcsec_per_unit);
    d["bias_arcsec_s"] = of(t.bias_arcsec_s);
    d["asymmetry_ppm"] = of(t.asymmetry_ppm);
    d["nonlinearity_ppm"] = t.nonlinearity_ppm;
    d["largest_residual_ppm"] = t.largest_residual_ppm;
    d["hysteresis_arcsec_s"] = t.hysteresis_arcsec_s;
    return d;
}

}  // namespace

void bind_noise(py::module_& m) {
    bind_terms(m);
    bind_units(m);
    m.def("fit_noise", &fit, py::arg("values"), py::arg("rate_hz"), py::arg("data_type"), py::arg("unit"),
          py::arg("valid"), py::arg("markov"), py::arg("most_sines"), py::arg("least_known_ratio"), py::arg("threads"));
    m.def("welch_spectrum", &spectrum, py::arg("rates_arcsec_s"), py::arg("rate_hz"), py::arg("piece"),
          py::arg("least_known_ratio"));
    m.def("spectrogram", &spectrogram_of, py::arg("rates_arcsec_s"), py::arg("rate_hz"), py::arg("piece"),
          py::arg("least_known_ratio"));
    m.def("split_modes", &modes, py::arg("rates_arcsec_s"), py::arg("mode"), py::arg("rate_hz"),
          py::arg("bridged_arcsec_s"), py::arg("settling_samples"));
    m.def("rate_table", &table, py::arg("input_arcsec_s"), py::arg("output"), py::arg("settling_samples"),
          py::arg("earth_arcsec_s"));
}

}  // namespace zlg::python
