#include <zlg/deviations/series.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

namespace zlg::deviations {
namespace {

constexpr double arcsec_per_rad = 180.0 * 3600.0 / std::numbers::pi;

struct UnitRow {
    Unit unit;
    std::string_view name;
    double arcsec;
    bool is_rate;
};

constexpr std::array<UnitRow, 8> units{{{Unit::arcsec, "arcsec", 1.0, false},
                                        {Unit::rad, "rad", arcsec_per_rad, false},
                                        {Unit::deg, "deg", 3600.0, false},
                                        {Unit::arcsec_s, "arcsec/s", 1.0, true},
                                        {Unit::rad_s, "rad/s", arcsec_per_rad, true},
                                        {Unit::deg_s, "deg/s", 3600.0, true},
                                        {Unit::deg_h, "deg/h", 1.0, true},
                                        {Unit::one, "1", 1.0, false}}};

const UnitRow& row_of(Unit unit) {
    for (const auto& row : units)
        if (row.unit == unit) return row;
    throw SeriesError(fmt::format("unit: number {} is none", static_cast<int>(unit)));
}

}  // namespace

bool is_rate(Unit unit) { return row_of(unit).is_rate; }
double in_arcsec(Unit unit) { return row_of(unit).arcsec; }
std::string_view name_of(Unit unit) { return row_of(unit).name; }

Unit unit_of(std::string_view name) {
    std::string allowed;
    for (const auto& row : units) {
        if (row.name == name) return row.unit;
        allowed += (allowed.empty() ? "" : ", ") + std::string(row.name);
    }
    throw SeriesError(fmt::format("unit: '{}' is unknown, allowed: {}", name, allowed));
}

DataKind data_kind_of(std::string_view name) {
    if (name == "increments") return DataKind::increments;
    if (name == "rate") return DataKind::rate;
    if (name == "phase") return DataKind::phase;
    throw SeriesError(fmt::format("data kind: '{}' is unknown, allowed: increments, rate, phase", name));
}

double rate_scale(const SeriesKind& what) {
    const double scale = in_arcsec(what.unit) * (what.kind == DataKind::rate ? 1.0 : what.rate_hz);
    return scale * scale;
}

void check(const Series& series) {
    const auto& what = series.what;
    if (!(std::isfinite(what.rate_hz) && what.rate_hz > 0.0))
        throw SeriesError(fmt::format("sampling rate: {} Hz, allowed is a positive number", what.rate_hz));
    if (what.unit != Unit::one && is_rate(what.unit) != (what.kind == DataKind::rate))
        throw SeriesError(fmt::format("unit: {} cannot be that of {}", name_of(what.unit),
                                      what.kind == DataKind::rate ? "a rate" : "an angle"));
    if (!series.valid.empty() && series.valid.size() != series.values.size())
        throw SeriesError(fmt::format("validity: {} marks for {} samples", series.valid.size(), series.values.size()));
    if (series.values.empty()) throw SeriesError("record: 0 samples, a deviation needs 3 or more");
}

}  // namespace zlg::deviations
