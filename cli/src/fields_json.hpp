#pragma once
// The fields of a result as JSON. A number that is not finite is null when it is printed.

#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <zlg/numeric/estimate.hpp>
#include <zlg/study/fields.hpp>

namespace zlg::cli {

// Member, and its key where that is another.
using Renamed = std::initializer_list<std::pair<std::string_view, std::string_view>>;

[[nodiscard]] inline nlohmann::json value_json(const numeric::Estimate& e) {
    if (!e.determined) return {{"determined", false}, {"reason", e.reason}};
    return {{"determined", true}, {"value", e.value}, {"sigma", e.sigma}};
}

[[nodiscard]] inline nlohmann::json value_json(const std::vector<numeric::Estimate>& all) {
    nlohmann::json values = nlohmann::json::array();
    for (const numeric::Estimate& e : all) values.push_back(value_json(e));
    return values;
}

template <class Value> [[nodiscard]] nlohmann::json value_json(const Value& value) { return value; }

template <class Result> [[nodiscard]] nlohmann::json fields_json(const Result& result, Renamed renamed = {}) {
    nlohmann::json fields;
    study::for_each_field<Result>([&](std::string_view name, auto get) {
        for (const auto& [member, key] : renamed)
            if (name == member) name = key;
        fields[std::string{name}] = value_json(get(result));
    });
    return fields;
}

template <class Result>
[[nodiscard]] nlohmann::json fields_json(const std::vector<Result>& results, Renamed renamed = {}) {
    nlohmann::json all = nlohmann::json::array();
    for (const Result& result : results) all.push_back(fields_json(result, renamed));
    return all;
}

}  // namespace zlg::cli
