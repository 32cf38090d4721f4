#pragma once
// The fields of a result as Python gets them.

#include <string>
#include <vector>

#include <zlg/numeric/estimate.hpp>
#include <zlg/study/fields.hpp>

#include "arrays.hpp"

namespace zlg::python {

// Value and sigma; None where it is not determined.
[[nodiscard]] inline py::object value_object(const numeric::Estimate& e) {
    return e.determined ? py::object{py::make_tuple(e.value, e.sigma)} : py::object{py::none()};
}

template <class Value> [[nodiscard]] py::object value_object(const Value& value) { return py::cast(value); }

template <class Result> [[nodiscard]] py::dict fields_dict(const Result& result) {
    py::dict fields;
    study::for_each_field<Result>([&](const char* name, auto get) { fields[name] = value_object(get(result)); });
    return fields;
}

template <class Result> [[nodiscard]] py::list fields_list(const std::vector<Result>& results) {
    py::list all;
    for (const Result& result : results) all.append(fields_dict(result));
    return all;
}

// Of many results one array a field.
template <class Row> void add_columns(py::dict& columns, const std::vector<Row>& rows, const std::string& prefix = {}) {
    study::for_each_field<Row>(
        [&](const char* name, auto get) { columns[py::str(prefix + name)] = column(rows, get); });
}

}  // namespace zlg::python
