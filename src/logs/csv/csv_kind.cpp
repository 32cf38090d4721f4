#include <zlg/logs/log_kind.hpp>

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include <zlg/logs/error.hpp>

#include "csv_head.hpp"

namespace zlg::logs {
namespace {

std::ptrdiff_t hits(const CsvHead& head, std::initializer_list<std::string_view> known) {
    return std::count_if(head.names.begin(), head.names.end(), [&](const std::string& name) {
        return std::find(known.begin(), known.end(), std::string_view{name}) != known.end();
    });
}

}  // namespace

LogKind recognise_text(const std::string& path) {
    try {
        LineReader lines{path};
        const CsvHead head = read_head(lines);
        const auto raw = hits(head, {"half", "bias_sign", "counts", "loop_closed"});
        const auto angle = hits(head, {"tick", "t_s", "dtheta_arcsec", "dtheta_final_arcsec", "sigma_arcsec", "flags"});
        if (raw >= 2 && raw > angle) return LogKind::raw_csv;
        if (angle >= 2 && angle > raw) return LogKind::angle_csv;
    } catch (const FormatError&) {
        // Not the text of a log: that is the answer, not a failure.
    }
    return LogKind::unknown;
}

}  // namespace zlg::logs
