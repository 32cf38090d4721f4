#include <zlg/study/term_text.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace zlg::study {

ShownTerm shown_term(noise::NoiseKind kind) {
    using noise::NoiseKind;
    switch (kind) {
        case NoiseKind::angle_random_walk:
            return {"deg/sqrt(h)", 1.0 / 60.0, "", ""};
        case NoiseKind::bias_instability:
            return {"deg/h", 1.0, "", ""};
        case NoiseKind::rate_random_walk:
            return {"deg/h/sqrt(h)", 60.0, "", ""};
        case NoiseKind::ramp:
            return {"deg/h/h", 3600.0, "", ""};
        case NoiseKind::markov:
            return {"deg/h", 1.0, "time", "s"};
        case NoiseKind::sine:
            return {"deg/h", 1.0, "frequency", "Hz"};
        case NoiseKind::quantisation:
            break;
    }
    return {"arcsec", 1.0, "", ""};
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

std::string value_text(const noise::FittedTerm& term) {
    const ShownTerm shown = shown_term(term.kind);
    if (!term.found)
        return std::isfinite(term.limit) ? fmt::format("below {:.2g} {}", term.limit * shown.factor, shown.unit)
                                         : "not found";
    std::string text =
        fmt::format("{} {}", with_error(term.value * shown.factor, term.sigma * shown.factor), shown.unit);
    if (!shown.second.empty())
        text += fmt::format(", {} {} {}", shown.second, with_error(term.second, term.second_sigma), shown.second_unit);
    return text;
}

}  // namespace zlg::study
