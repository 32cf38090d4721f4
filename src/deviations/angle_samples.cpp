#include <zlg/deviations/angle_samples.hpp>

#include <memory>

#include <fmt/format.h>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>

namespace zlg::deviations {

AngleSamples angle_samples(const std::string& path, AngleColumn column, std::uint32_t missing_flags) {
    const auto log = std::make_shared<logs::AngleReader>(path);
    const auto tick_s = logs::said_tick_s(log->header().settings);
    if (!tick_s)
        throw logs::FormatError(fmt::format("{}: no setting tick_s, a deviation needs the length of a tick", path));
    const auto angle =
        column == AngleColumn::dtheta ? &core::AngleRow::dtheta_arcsec : &core::AngleRow::dtheta_final_arcsec;
    const auto source = [log, angle, missing_flags](std::span<double> values, std::span<std::uint8_t> valid) {
        logs::TimedAngle tick;
        std::size_t n = 0;
        for (; n < values.size() && log->next(tick); ++n) {
            values[n] = tick.row.*angle;
            valid[n] = (tick.row.flags & missing_flags) == 0 ? 1 : 0;
        }
        return n;
    };
    return {.what = {DataKind::increments, Unit::arcsec, 1.0 / *tick_s}, .source = source};
}

}  // namespace zlg::deviations
