#include <zlg/study/term_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace zlg::study {

ShownTerm shown_term(noise::NoiseKind kind) {
    // In the order of the enumerators.
    static const std::array<ShownTerm, 7> terms{{{"arcsec", 1.0, "", ""},
                                                 {"deg/sqrt(h)", 1.0 / 60.0, "bandwidth", "Hz"},
                                                 {"deg/h", 1.0, "", ""},
                                                 {"deg/h/sqrt(h)", 60.0, "", ""},
                                                 {"deg/h/h", 3600.0, "", ""},
                                                 {"deg/h", 1.0, "time", "s"},
                                                 {"deg/h", 1.0, "frequency", "Hz"}}};
    return terms.at(static_cast<std::size_t>(kind));
}

std::string with_error(double value, double sigma) {
    if (!std::isfinite(value)) return "none";
    if (!(sigma > 0.0) || !std::isfinite(sigma)) return fmt::format("{:.4g}", value);
    // The error with two digits, the value as far as them.
    const int place = static_cast<int>(std::floor(std::log10(sigma))) - 1;
    const bool plain = std::abs(value) < 1e7 && std::max(std::abs(value), sigma) >= 1e-4;
    if (plain && place <= 0) return fmt::format("{:.{}f} +- {:.{}f}", value, -place, sigma, -place);
    const int digits =
        value == 0.0 ? 2 : std::clamp(static_cast<int>(std::floor(std::log10(std::abs(value)))) - place + 1, 2, 15);
    return fmt::format("{:.{}g} +- {:.2g}", value, digits, sigma);
}

std::string value_text(const numeric::Estimate& e, std::string_view unit) {
    return e.determined ? fmt::format("{} {}", with_error(e.value, e.sigma), unit) : "not determined: " + e.reason;
}

std::string value_text(const noise::FittedTerm& term) {
    const ShownTerm shown = shown_term(term.kind);
    if (!term.found)
        return std::isfinite(term.limit) ? fmt::format("below {:.2g} {}", term.limit * shown.factor, shown.unit)
                                         : "not found";
    std::string text =
        fmt::format("{} {}", with_error(term.value * shown.factor, term.sigma * shown.factor), shown.unit);
    if (std::isfinite(term.second))
        text += fmt::format(", {} {} {}", shown.second, with_error(term.second, term.second_sigma), shown.second_unit);
    return text;
}

}  // namespace zlg::study
