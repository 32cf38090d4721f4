#include <zlg/config/schema.hpp>
#include <zlg/sweep/checkpoint.hpp>
#include <zlg/sweep/metrics.hpp>
#include <zlg/sweep/sweep.hpp>

#include "arrays.hpp"
#include "bind.hpp"
#include "interruption.hpp"

namespace zlg::python {
namespace {

py::list number_or_text(const std::vector<sweep::Value>& values) {
    py::list column;
    for (const sweep::Value& value : values) std::visit([&](const auto& each) { column.append(each); }, value);
    return column;
}

// Name, unit and values of each column, in the order of the file.
py::list columns_of(const sweep::Gyros& gyros, const sweep::Rows& rows) {
    py::list columns;
    const auto add = [&](const std::string& name, const std::string& unit, py::object values) {
        columns.append(py::make_tuple(name, unit, std::move(values)));
    };
    const auto of_rows = [&](const auto& get) {
        std::vector<std::decay_t<decltype(get(rows.begin()->second))>> values;
        for (const auto& [gyro, row] : rows) values.push_back(get(row));
        return values;
    };
    add("gyro", "1", as_array(of_rows([](const sweep::Row& r) { return r.gyro; })));
    add("seed", "1", as_array(of_rows([&](const sweep::Row& r) { return gyros.seed(r.gyro); })));
    const std::vector<sweep::Parameter>& parameters = gyros.description().parameters;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
        const py::list values = number_or_text(of_rows([&](const sweep::Row& r) { return gyros.values(r.gyro)[k]; }));
        for (const std::string& key : parameters[k].keys) add(key, config::unit_of(key), values);
    }
    const std::vector<sweep::Metric>& metrics = gyros.description().metrics;
    for (std::size_t k = 0; k < metrics.size(); ++k)
        add(metrics[k].name, sweep::unit_of(metrics[k].name),
            as_array(of_rows([k](const sweep::Row& r) { return r.metrics[k]; })));
    add("status", "1", as_array(of_rows([](const sweep::Row& r) { return static_cast<std::int64_t>(r.status); })));
    add("reason", "", py::cast(of_rows([](const sweep::Row& r) { return r.reason; })));
    add("fingerprint", "", py::cast(of_rows([](const sweep::Row& r) { return r.fingerprint; })));
    add("command", "", py::cast(of_rows([&](const sweep::Row& r) { return gyros.command(r.gyro); })));
    return columns;
}

py::list run_sweep(const std::string& description, const std::string& source_name, const std::string& out,
                   std::int64_t part, std::int64_t parts, int threads, bool force, const py::object& progress) {
    if (!(part >= 1 && part <= parts)) throw std::invalid_argument{"part: allowed is (k, n) with 1 <= k <= n"};
    if (!(threads >= 1)) throw std::invalid_argument{"threads: allowed is 1 and more"};
    Interruption interruption;
    sweep::Task task{.description = sweep::parse(description, source_name),
                     .out = out,
                     .part = {part, parts},
                     .threads = threads,
                     .force = force,
                     .is_stopped = std::ref(interruption)};
    task.on_progress = [&](std::int64_t done, std::int64_t asked) {
        const py::gil_scoped_acquire interpreter;
        if (!progress.is_none()) progress(static_cast<double>(done) / static_cast<double>(asked));
    };
    const sweep::Outcome outcome = without_interpreter([&] { return sweep::run(task); });
    interruption.raise();
    return columns_of(sweep::Gyros{task.description}, outcome.rows);
}

// The description, and the columns.
py::tuple read_sweep(const std::string& path) {
    const sweep::Results results = without_interpreter(
        [&] { return sweep::is_checkpoint(path) ? sweep::read_checkpoint(path) : sweep::read_results(path); });
    const sweep::Gyros gyros{sweep::parse(results.description, path)};
    return py::make_tuple(results.description, columns_of(gyros, results.rows));
}

}  // namespace

void bind_sweep(py::module_& m) {
    m.def("sweep", &run_sweep);
    m.def("read_sweep", &read_sweep);
}

}  // namespace zlg::python
