#include "trend.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/report/number_text.hpp>

namespace zlg::acceptance {
namespace {

using nlohmann::json;
using namespace report;

// What a test is known by, whatever its report was called and was compared with.
json key_of(json record) {
    record.erase("command");
    return record;
}

// By date, then by serial number; each once.
std::vector<json> in_order(const Acceptance& test, const std::string& own, const std::vector<std::string>& earlier) {
    std::vector<json> all{json::parse(own)};
    for (const std::string& text : earlier) {
        json record = json::parse(text);
        const bool is_there = std::ranges::find(all, key_of(record), key_of) != all.end();
        if (record.at("unit").at("type") != test.plan.unit.type || is_there) continue;
        all.push_back(std::move(record));
    }
    std::ranges::stable_sort(all, {}, [](const json& r) {
        return std::pair{r.at("unit").at("date").get<std::string>(), r.at("unit").at("serial").get<std::string>()};
    });
    return all;
}

Figure trend_figure(const Judged& judged, const std::vector<json>& all) {
    const QuantityInfo& q = *find_quantity(judged.value.name);
    Figure f = blank_figure(
        fmt::format("trend-{}", q.name.substr(0, q.name.find('.'))), std::string{q.name},
        "Each test in the order of the table; bars: twice the standard uncertainty; dashed: the limits of this test.",
        "number of the test", fmt::format("{}, {}", q.name.substr(0, q.name.find('.')), q.unit));
    std::ranges::replace(f.id, '_', '-');
    Series values = blank_series("tests", Mark::points);
    for (std::size_t k = 0; k < all.size(); ++k)
        for (const json& one : all[k].at("quantities")) {
            if (one.at("name") != q.name || !one.at("value").is_number()) continue;
            add_point(values, static_cast<double>(k + 1), one.at("value").get<double>());
            values.y_error.push_back(one.at("uncertainty").is_number() ? 2.0 * one.at("uncertainty").get<double>()
                                                                       : 0.0);
        }
    f.series.push_back(std::move(values));
    for (const auto& limit : {judged.limit->min, judged.limit->max}) {
        if (!limit) continue;
        Series line = blank_series(limit == judged.limit->max ? "max" : "min", Mark::line, true);
        for (const double x : {0.5, static_cast<double>(all.size()) + 0.5}) add_point(line, x, *limit);
        f.series.push_back(std::move(line));
    }
    return f;
}

}  // namespace

Section trend_section(const Acceptance& test, const std::string& own, const std::vector<std::string>& earlier) {
    const std::vector<json> all = in_order(test, own, earlier);
    Section s{.heading = "Earlier tests of this type"};
    Table t{.caption = "Tests of the same type by date.", .header = {"number", "date", "serial", "passed"}};
    for (std::size_t k = 0; k < all.size(); ++k) {
        const json& unit = all[k].at("unit");
        t.rows.push_back({fmt::format("{}", k + 1), unit.at("date").get<std::string>(),
                          unit.at("serial").get<std::string>(), all[k].at("passed").get<bool>() ? "yes" : "no"});
    }
    s.tables.push_back(std::move(t));
    for (const Judged& judged : test.quantities)
        if (judged.limit) s.figures.push_back(trend_figure(judged, all));
    return s;
}

}  // namespace zlg::acceptance
