#pragma once
// What of each result leaves the program as numbers and texts: to JSON, to the table of switches, to Python.
//
// BOOST_HANA_ADAPT_STRUCT lists members of a struct; for_each_field goes through such a list. A member that only one
// face shows, that it shows under another name, or that holds a result itself, is a matter of that face.

#include <boost/hana/accessors.hpp>
#include <boost/hana/adapt_struct.hpp>
#include <boost/hana/first.hpp>
#include <boost/hana/for_each.hpp>
#include <boost/hana/second.hpp>
#include <boost/hana/string.hpp>
#include <boost/hana/tuple.hpp>

#include <zlg/calibration/rate_table.hpp>
#include <zlg/deviations/deviation.hpp>
#include <zlg/logs/wire_rows.hpp>
#include <zlg/noise/mode_split.hpp>
#include <zlg/noise/noise_fit.hpp>
#include <zlg/noise/noise_units.hpp>
#include <zlg/study/analyze.hpp>
#include <zlg/study/calibrate.hpp>
#include <zlg/study/design_study.hpp>
#include <zlg/study/run.hpp>

BOOST_HANA_ADAPT_STRUCT(zlg::study::SwitchLine, tick, mode, miss_lambda, half_wave_v, half_wave_sigma_v, gap_ticks,
                        dp_arcsec, relock_arcsec, sigma_arcsec, true_error_arcsec);
BOOST_HANA_ADAPT_STRUCT(zlg::study::VariantResult, name, drift_arcsec_s, drift_without_nonmagnetic_arcsec_s,
                        angle_error_arcsec, angle_error_without_nonmagnetic_arcsec);
BOOST_HANA_ADAPT_STRUCT(zlg::study::SwitchStatistics, mean_arcsec, rms_arcsec, max_arcsec);
BOOST_HANA_ADAPT_STRUCT(zlg::design::Optimum, interval_s, drift_arcsec_s);
BOOST_HANA_ADAPT_STRUCT(zlg::design::DriftTerms, nonmagnetic_arcsec_s, quasi_nonmagnetic_arcsec_s, sawtooth_arcsec_s,
                        switch_errors_arcsec_s);
BOOST_HANA_ADAPT_STRUCT(zlg::design::Margins, phase_margin_deg, gain_margin, crossover_rad_s, stable);
BOOST_HANA_ADAPT_STRUCT(zlg::design::InitialMiss, root_sum_square_lambda, worst_lambda);
BOOST_HANA_ADAPT_STRUCT(zlg::study::LoopLine, tick_over_tau, stability_limit, stability_note, relock_note, relock_s,
                        false_drift_arcsec_s, false_angle_arcsec, false_angle_law_arcsec, capture_lambda);
BOOST_HANA_ADAPT_STRUCT(zlg::study::SubstitutionLine, order, gap_ticks, frequency_hz, worst_arcsec, rms_arcsec,
                        noise_gain, counter_arcsec, relock_arcsec, total_arcsec);
BOOST_HANA_ADAPT_STRUCT(zlg::study::AxisResult, name, holds, rate_hz, n_samples, n_known, n_gaps, is_error,
                        mean_arcsec_s, mean_sigma_arcsec_s);
BOOST_HANA_ADAPT_STRUCT(zlg::study::Readout, what, tau_s, deviation_arcsec_s);
BOOST_HANA_ADAPT_STRUCT(zlg::study::EarthLine, group, n_axes, norm_arcsec_s, sigma_arcsec_s);
BOOST_HANA_ADAPT_STRUCT(zlg::deviations::DeviationPoint, tau_s, m, deviation, low, high, terms, noise, as_computed);
BOOST_HANA_ADAPT_STRUCT(zlg::noise::FittedTerm, found, value, sigma, limit, read_at_s);
BOOST_HANA_ADAPT_STRUCT(zlg::noise::NoiseFit, chi2, dof, probability, model_error, describes, from_tau_s);
BOOST_HANA_ADAPT_STRUCT(zlg::noise::FitPoint, tau_s, measured, fitted, degrees);
BOOST_HANA_ADAPT_STRUCT(zlg::noise::DataSheet, quantisation_arcsec, angle_random_walk_deg_sqrt_h,
                        bias_instability_deg_h, rate_random_walk_deg_h_sqrt_h, ramp_deg_h_h);
BOOST_HANA_ADAPT_STRUCT(zlg::noise::DiscreteNoise, white_rate_arcsec_s, white_increment_arcsec, walk_step_arcsec_s,
                        angle_error_arcsec, ramp_step_arcsec_s, markov_factor, markov_step_arcsec_s);
BOOST_HANA_ADAPT_STRUCT(zlg::noise::BiasTemperature, mean_c, least_c, most_c, order, bias, scale, hysteresis_arcsec_s);
BOOST_HANA_ADAPT_STRUCT(zlg::noise::ModeSegment, mode, time_s, known_s, rate_arcsec_s);
BOOST_HANA_ADAPT_STRUCT(zlg::noise::SwitchAngle, time_s, mode_after, error_arcsec);
BOOST_HANA_ADAPT_STRUCT(zlg::noise::SwitchStatistics, n, mean_arcsec, mean_sigma_arcsec, mean_by_mode_arcsec,
                        rms_arcsec, max_arcsec);
BOOST_HANA_ADAPT_STRUCT(zlg::noise::ModeSplit, nonmagnetic_arcsec_s, magnetic_arcsec_s, magnetic_thermal_arcsec_s,
                        thermal_time_s);
BOOST_HANA_ADAPT_STRUCT(zlg::noise::ModePoint, time_s, magnetic_arcsec_s, nonmagnetic_arcsec_s);
BOOST_HANA_ADAPT_STRUCT(zlg::calibration::Goodness, name, value, meaning);
BOOST_HANA_ADAPT_STRUCT(zlg::study::CalibratedLog, path, duration_s, segments, relocks);
BOOST_HANA_ADAPT_STRUCT(zlg::calibration::TableStage, input_arcsec_s, output, output_sigma, n_samples, residual_ppm);
BOOST_HANA_ADAPT_STRUCT(zlg::calibration::RateTable, scale_factor, arcsec_per_unit, bias_arcsec_s, asymmetry_ppm,
                        nonlinearity_ppm, largest_residual_ppm, hysteresis_arcsec_s);

namespace zlg::study {

// What is counted of a gyro's line: the name for JSON and Python, and the words of a text, empty for what it says
// otherwise.
struct LineCount {
    const char* name;
    std::uint64_t logs::WireSummary::*member;
    const char* words = "";
};

inline constexpr LineCount line_counts[] = {
    {"bytes", &logs::WireSummary::n_bytes},
    {"telemetry_messages", &logs::WireSummary::n_telemetry},
    {"status_messages", &logs::WireSummary::n_status},
    {"replies", &logs::WireSummary::n_replies},
    {"lost_messages", &logs::WireSummary::n_lost_messages, "messages lost, by their numbers"},
    {"lost_ticks", &logs::WireSummary::n_lost_rows, "ticks lost; their angle is shared out among them"},
    {"final_lost_ticks", &logs::WireSummary::n_final_lost_rows, "ticks without a final value"},
    {"restarts", &logs::WireSummary::n_restarts, "restarts of the gyro; its turn meanwhile is not in the log"},
    {"outages", &logs::WireSummary::n_outages},
    {"outage_ticks", &logs::WireSummary::n_outage_ticks},
    {"other_tick_messages", &logs::WireSummary::n_other_tick},
    {"damaged_frames", &logs::WireSummary::n_damaged, "damaged frames"},
    {"damaged_bytes", &logs::WireSummary::n_damaged_bytes, "bytes in them"},
    {"foreign_frames", &logs::WireSummary::n_foreign,
     "of them whole, but of another version of the line: from a gyro with other software"},
    {"refused_messages", &logs::WireSummary::n_refused, "whole frames that no gyro of ours sends"},
    {"unfitting_messages", &logs::WireSummary::n_unfitting,
     "messages that fit neither those before them nor those after"},
    {"repeated_messages", &logs::WireSummary::n_repeated, "messages that came again or too late"},
};

// use(name, get) for each: get(result) is its value.
template <class Result, class Use> void for_each_field(Use use) {
    namespace hana = boost::hana;
    hana::for_each(hana::accessors<Result>(),
                   [&use](const auto& field) { use(hana::first(field).c_str(), hana::second(field)); });
}

}  // namespace zlg::study
