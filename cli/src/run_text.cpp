#include "run_text.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <zlg/study/what_happened.hpp>

namespace zlg::cli {
namespace {

struct Row {
    std::vector<std::string> names;
    std::string numbers;
};

constexpr std::size_t name_width = 21;

std::string cell(const std::optional<study::SwitchStatistics>& s, double study::SwitchStatistics::*member) {
    return s ? fmt::format("{:.2f}", (*s).*member) : "-";
}

// A blank before each, however long it is.
std::string numbers(const study::VariantResult& v) {
    using study::SwitchStatistics;
    return fmt::format(" {:>7} {:>7} {:>7} {:>8.4f} {:>7.1f} {:>8.4f} {:>7.1f}",
                       cell(v.switch_error, &SwitchStatistics::rms_arcsec),
                       cell(v.switch_error, &SwitchStatistics::mean_arcsec),
                       cell(v.switch_error, &SwitchStatistics::max_arcsec), v.drift_without_nonmagnetic_arcsec_s,
                       v.angle_error_without_nonmagnetic_arcsec, v.drift_arcsec_s, v.angle_error_arcsec);
}

std::vector<Row> rows(const study::RunResult& result) {
    std::vector<Row> all;
    const auto add = [&all](const study::VariantResult& v) {
        const std::string shown = numbers(v);
        const auto equal = std::ranges::find(all, shown, &Row::numbers);
        if (equal == all.end())
            all.push_back({{v.name}, shown});
        else
            equal->names.push_back(v.name);
    };
    for (const study::VariantResult& v : result.variants) add(v);
    add(result.magnetic_estimate);
    return all;
}

// The names of a row, in lines that fit their column; the numbers stand in the last.
std::string lines(const Row& row) {
    std::string text;
    std::string line;
    for (const std::string& name : row.names) {
        if (!line.empty()) line += ',';
        if (line.size() + 1 + name.size() + 1 > name_width && !line.empty()) {
            text += line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : " ") + name;
    }
    return text + fmt::format("{:<{}}{}\n", line, name_width, row.numbers);
}

constexpr const char* table_head = R"(
                      error of a switch,      without the constant    with it
                      arcsec                  drift    at end         drift    at end
compensation              rms    mean     max arcsec/s  arcsec arcsec/s  arcsec
)";

std::string remarks(const config::Config& config, const study::RunResult& result) {
    std::string text = fmt::format(
        "\nDrift is the slope of the angle error, final minus true; 1 arcsec/s is 1 deg/h. The constant is\nthe "
        "non-magnetic drift, {:g} arcsec/s, which a measurement removes as a bias.\n",
        config.drift.nonmagnetic_arcsec_s);
    const study::RandomWalkShare walk = study::random_walk_share(config, result);
    if (walk.drift_arcsec_s > 0.0)
        text += fmt::format("The random walk alone makes +-{:.2g} arcsec/s of drift and +-{:.2g} arcsec at the end.\n",
                            walk.drift_arcsec_s, walk.angle_arcsec);
    return text + "All rows compensate the records of one run; one_mode is a run without switching.\n";
}

}  // namespace

std::string run_text(const config::Config& config, const study::RunResult& result) {
    std::string text;
    for (const std::string& sentence : study::what_happened(config, result)) text += sentence + "\n";
    text += table_head;
    for (const Row& row : rows(result)) text += lines(row);
    return text + remarks(config, result);
}

}  // namespace zlg::cli
