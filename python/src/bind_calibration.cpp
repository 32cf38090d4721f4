#include <map>
#include <utility>

#include <zlg/logs/table_file.hpp>
#include <zlg/study/calibrate.hpp>

#include "bind.hpp"
#include "fields_dict.hpp"
#include "log_columns.hpp"

namespace zlg::python {
namespace {

// A log in memory: the columns, settings and timer of a RawLog.
struct HeldLog {
    RawView rows;
    logs::RawHeader header;

    [[nodiscard]] logs::RawReader reader(const std::string& name) const {
        std::vector<core::HalfRecord> records;
        records.reserve(rows.size());
        for (std::size_t row = 0; row < rows.size(); ++row) records.push_back(rows.record(row));
        return {name, header, std::move(records)};
    }
};

py::dict constant(const calibration::Constant& c) {
    return py::dict("key"_a = c.key, "value"_a = c.estimate.value, "sigma"_a = c.estimate.sigma, "unit"_a = c.unit);
}

py::object discriminator(const study::CalibrationResult& result) {
    const calibration::LossCurve& curve = result.calibration.curve;
    if (!curve.determined) return py::none();
    return py::dict("detuning_lambda"_a = as_array(curve.detuning_lambda),
                    "signal"_a = as_array(study::curve_signals(result)),
                    "sigma_lambda"_a = as_array(curve.sigma_lambda));
}

py::list logs_of(const study::CalibrationResult& result) {
    py::list all = fields_list(result.logs);
    for (std::size_t k = 0; k < result.logs.size(); ++k) {
        const study::CalibratedLog& log = result.logs[k];
        all[k]["temperature_c"] =
            log.has_temperature ? py::object{py::make_tuple(log.temperature_min_c, log.temperature_max_c)} : py::none();
    }
    return all;
}

// `held` of each log that is in memory, by its name; the others are files.
py::dict calibrate(const std::vector<std::string>& names, const py::dict& held, double rate_arcsec_s,
                   const config::Config& said, const py::object& progress) {
    const Progress notify{progress};
    std::map<std::string, HeldLog> in_memory;
    for (const auto& [name, each] : held) {
        const auto columns = py::cast<py::dict>(each);
        logs::RawHeader header = header_of(columns, py::cast<double>(columns["timer_hz"]));
        header.settings = py::cast<logs::Settings>(columns["settings"]);
        in_memory.emplace(py::cast<std::string>(name), HeldLog{RawView{columns}, std::move(header)});
    }
    const auto open = [&in_memory](const std::string& name) {
        const auto found = in_memory.find(name);
        return found == in_memory.end() ? logs::RawReader{name} : found->second.reader(name);
    };
    const study::CalibrationResult result = without_interpreter([&] {
        return study::calibrate({.logs = names,
                                 .rate_arcsec_s = rate_arcsec_s,
                                 .said = said,
                                 .open = open,
                                 .on_progress = std::cref(notify)});
    });
    py::list constants;
    py::dict not_determined;
    for (const calibration::Constant& c : result.calibration.constants) {
        if (c.estimate.determined)
            constants.append(constant(c));
        else
            not_determined[py::str(c.key)] = c.estimate.reason;
    }
    if (!result.calibration.curve.determined)
        not_determined["perimeter.discriminator_signal"] = result.calibration.curve.reason;
    if (result.calibration.bias_table.knots.empty())
        not_determined["gyro.bias_temperature_table"] = result.calibration.bias_table.reason;
    return py::dict("constants"_a = constants, "not_determined"_a = not_determined,
                    "bias_chi_higher"_a = result.calibration.chi_higher, "discriminator"_a = discriminator(result),
                    "goodness"_a = fields_list(result.calibration.goodness), "logs"_a = logs_of(result),
                    "tick_s"_a = result.config.gyro.tick_s, "scale_arcsec"_a = result.config.gyro.scale_arcsec,
                    "reference_temperature_c"_a = result.config.gyro.reference_temperature_c,
                    "toml"_a = study::calibration_toml(result), "warnings"_a = result.warnings);
}

void write_text(const std::string& path, const std::string& text, bool force) {
    logs::TableFile file{path, force};
    file.append(text);
    file.close();
}

}  // namespace

void bind_calibration(py::module_& m) {
    m.def("calibrate", &calibrate);
    m.def("write_text", &write_text);
}

}  // namespace zlg::python
