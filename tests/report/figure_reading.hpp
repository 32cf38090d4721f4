#pragma once
// What a reader takes from a printed figure: numbers of the tick labels, values of places, the plot's frame.

#include "markup.hpp"

namespace reading {

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from)) {
        text.replace(at, from.size(), to);
    }
    return text;
}

// The number a reader sees in a tick label.
inline double label_value(std::string text) {
    text = replaced(text, "\u00A0", "");
    text = replaced(text, "\u2212", "-");
    text = replaced(text, "\u207B", "-");
    const char* superscripts[] = {"\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                  "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    const bool power = text.find("10-") != std::string::npos ||
                       std::any_of(std::begin(superscripts), std::end(superscripts),
                                   [&](const char* s) { return text.find(s) != std::string::npos; });
    for (int i = 0; i < 10; ++i) text = replaced(text, superscripts[i], std::to_string(i));
    if (power && text.rfind("10", 0) == 0) text = "1e" + text.substr(2);
    return std::stod(replaced(text,
                              "\u00B7"
                              "10",
                              "e"));
}

struct TickSeen {
    double at = 0.0;
    double value = 0.0;
};

inline std::vector<TickSeen> ticks_seen(const std::vector<markup::Element>& elements, const std::string& group) {
    std::vector<TickSeen> out;
    for (const auto& text : markup::all(elements, "text", group)) {
        const bool horizontal = group == "x-ticks";
        // A label of the left axis stands 5.5 units low, so that its middle is at its tick.
        out.push_back(
            {horizontal ? markup::number(text, "x") : markup::number(text, "y") - 5.5, label_value(text.text)});
    }
    return out;
}

// Read a place off an axis as a reader does: between its outermost ticks.
inline double read_off(const std::vector<TickSeen>& ticks, double at, bool log) {
    const TickSeen& a = ticks.front();
    const TickSeen& b = ticks.back();
    const double share = (at - a.at) / (b.at - a.at);
    if (log) return std::pow(10.0, std::log10(a.value) + share * std::log10(b.value / a.value));
    return a.value + share * (b.value - a.value);
}

struct Frame {
    double left, top, right, bottom;
};

inline Frame plot_of(const std::vector<markup::Element>& elements) {
    const auto plot = markup::of_class(elements, "plot");
    const double left = markup::number(plot, "x");
    const double top = markup::number(plot, "y");
    return {left, top, left + markup::number(plot, "width"), top + markup::number(plot, "height")};
}

inline bool is_round(double value) {
    const double lead = value / std::pow(10.0, std::floor(std::log10(value) + 1e-9));
    return std::fabs(lead - 1.0) < 1e-6 || std::fabs(lead - 2.0) < 1e-6 || std::fabs(lead - 5.0) < 1e-6;
}

}  // namespace reading
