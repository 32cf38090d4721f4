#include <zlg/deviations/angle_samples.hpp>

#include <memory>
#include <vector>

#include <fmt/format.h>
#include <zlg/logs/error.hpp>

namespace zlg::deviations {

AngleSamples angle_samples(const std::string& path, logs::AngleColumn column, std::uint32_t missing_flags) {
    const auto log = std::make_shared<logs::AngleIncrements>(path, column);
    const auto tick_s = log->tick_s();
    if (!tick_s)
        throw logs::FormatError(fmt::format("{}: no setting tick_s, a deviation needs the length of a tick", path));
    const auto source = [log, missing_flags, flags = std::vector<std::uint32_t>()](
                            std::span<double> values, std::span<std::uint8_t> valid) mutable {
        flags.resize(values.size());
        const std::size_t n = log->read(values, flags);
        for (std::size_t k = 0; k < n; ++k) valid[k] = (flags[k] & missing_flags) == 0 ? 1 : 0;
        return n;
    };
    return {.what = {DataKind::increments, Unit::arcsec, 1.0 / *tick_s}, .source = source};
}

}  // namespace zlg::deviations
