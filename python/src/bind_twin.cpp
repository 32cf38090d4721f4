#include <stdexcept>

#include <zlg/config/config.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/fields.hpp>
#include <zlg/twin/twin.hpp>

#include "arrays.hpp"
#include "bind.hpp"

BOOST_HANA_ADAPT_STRUCT(zlg::core::SensorFrame, sequence, timer_ticks, counter, bias_sign, polarity, loop_closed,
                        piezo_v, coil_current_a, temperature_c, status, has_fringe, fringe_quarter, fringe_c, fringe_s);
BOOST_HANA_ADAPT_STRUCT(zlg::core::ActuatorFrame, loop_closed, polarity, edge_offset_ticks);
BOOST_HANA_ADAPT_STRUCT(zlg::twin::TwinTruth, dtheta_arcsec, false_relock_arcsec, detuning_end_lambda, perimeter_v,
                        rounding_arcsec, random_walk_arcsec, lit);

namespace zlg::python {
namespace {

using core::ActuatorFrame;
using core::SensorFrame;

twin::Motion sines(double rate_arcsec_s, const std::vector<std::tuple<double, double, double>>& sines) {
    std::vector<twin::Sine> terms;
    for (const auto& [amplitude, frequency, phase] : sines) terms.push_back({amplitude, frequency, phase});
    return twin::Motion::sines(rate_arcsec_s, std::move(terms));
}

void bind_motion(py::module_& m) {
    py::class_<twin::Motion>(m, "Motion", "Rotation of the gyro's case, as an angle that is a function of time.")
        .def_static("rest", &twin::Motion::rest, "A case that does not turn.")
        .def_static("sines", &sines, "rate_arcsec_s"_a, "sines"_a,
                    "A constant rate plus sines (amplitude_arcsec_s, frequency_hz, phase_deg).")
        .def_static(
            "from_increments",
            [](const In<double>& increments, double rate_hz) {
                const auto values = span_of(increments, "increment_arcsec");
                return twin::Motion::from_increments({values.begin(), values.end()}, rate_hz);
            },
            "increment_arcsec"_a, "rate_hz"_a,
            "Increment k, arcsec, is the rotation from k/rate_hz to (k + 1)/rate_hz.")
        .def(
            "increment_arcsec",
            [](const twin::Motion& motion, const In<double>& t0_s, const In<double>& t1_s) {
                return of_each([&](double t0, double t1) { return motion.increment_arcsec(t0, t1); }, t0_s, t1_s);
            },
            "t0_s"_a, "t1_s"_a, "Rotation from t0_s to t1_s, arcsec; arrays are taken element by element.")
        .def_property_readonly("duration_s", &twin::Motion::duration_s, "Length of sampled motion; inf of others.");
}

// The samples of one beam, shape (n_light,).
py::array_t<float> beam(const std::array<float, core::max_light_samples>& samples, std::uint8_t n) {
    return as_array(std::vector<float>{samples.begin(), samples.begin() + n});
}

template <class Struct> py::class_<Struct> add_members(py::class_<Struct> type) {
    study::for_each_field<Struct>([&type](const char* name, auto get) {
        using Value = std::remove_cvref_t<decltype(get(std::declval<Struct&>()))>;
        type.def_property(
            name, [get](const Struct& s) { return get(s); }, [get](Struct& s, const Value& value) { get(s) = value; });
    });
    return type;
}

void bind_frames(py::module_& m) {
    add_members(
        py::class_<SensorFrame>{m, "SensorFrame", "What the gyro's electronics latch at the end of a half-period."})
        .def(py::init<>())
        .def_property_readonly("light_a", [](const SensorFrame& f) { return beam(f.light_a, f.n_light); })
        .def_property_readonly("light_b", [](const SensorFrame& f) {
            return beam(f.light_b, f.has_light_b ? f.n_light : std::uint8_t{0});
        });
    add_members(py::class_<ActuatorFrame>{m, "ActuatorFrame", "What the processor commands for the next half-period."})
        .def(py::init<>())
        .def_property(
            "set_point_v",
            [](const ActuatorFrame& f) {
                return as_array(std::vector<double>{f.set_point_v.begin(), f.set_point_v.begin() + f.n_set_points});
            },
            [](ActuatorFrame& f, const In<double>& volts) {
                const auto values = span_of(volts, "set_point_v");
                if (values.empty() || values.size() > core::max_set_points)
                    throw std::invalid_argument{"set_point_v: allowed are 1..16 voltages"};
                std::copy(values.begin(), values.end(), f.set_point_v.begin());
                f.n_set_points = static_cast<std::uint8_t>(values.size());
            });
}

twin::Twin twin_of(const config::Config& config, const std::optional<twin::Motion>& motion) {
    const twin::TwinConfig made = rig::twin_config(config);
    twin::Motion turning = motion ? *motion : recorded::motion(config);
    try {
        return twin::Twin{made, std::move(turning)};
    } catch (const std::runtime_error& error) {
        // A laser without light, or one whose light no table can hold.
        throw config::ConfigError{std::string{"[laser] does not make a gyro: "} + error.what()};
    }
}

std::pair<SensorFrame, twin::TwinTruth> advance_twin(twin::Twin& twin, const ActuatorFrame& actuator) {
    try {
        twin::TwinHalf half = twin.advance(actuator);
        return {half.sensor, half.truth};
    } catch (const std::overflow_error& error) {
        throw config::ConfigError{std::string{"[gyro], [drift] or [motion] asks for a rate beyond any counter: "} +
                                  error.what()};
    }
}

}  // namespace

void bind_twin(py::module_& m) {
    bind_motion(m);
    bind_frames(m);
    add_members(py::class_<twin::TwinTruth>{m, "TwinTruth", "What happened in a half-period and no gyro knows."});
    py::class_<twin::Twin>(m, "Twin").def(py::init(&twin_of)).def("advance", &advance_twin);
}

}  // namespace zlg::python
