#pragma once

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <zlg/trials/physics_pictures.hpp>

namespace zlg::trials {

[[nodiscard]] Picture chain_picture();
void add_waves(PhysicsPictures& made);
void add_bias(PhysicsPictures& made);
void add_discriminator(PhysicsPictures& made);
void add_field(PhysicsPictures& made);
void add_lock_in(PhysicsPictures& made);
void add_switch(PhysicsPictures& made);
void add_piezo(PhysicsPictures& made);
void add_misses(PhysicsPictures& made);

inline void add(report::Series& series, double x, double y) {
    series.x.push_back(x);
    series.y.push_back(y);
}

[[nodiscard]] inline report::Series line(std::string name, bool dashed = false, int colour = -1) {
    return {.name = std::move(name), .x = {}, .y = {}, .y_error = {}, .dashed = dashed, .colour = colour};
}

[[nodiscard]] inline report::Series points(std::string name) {
    return {.name = std::move(name), .x = {}, .y = {}, .y_error = {}, .mark = report::Mark::points};
}

inline void read(PhysicsPictures& made, std::string quantity, const std::vector<double>& values, int decimals,
                 std::string unit = "") {
    std::string text;
    for (const double value : values) text += fmt::format("{}{:.{}f}", text.empty() ? "" : ", ", value, decimals);
    made.readings.push_back({std::move(quantity), std::move(text), std::move(unit)});
}

}  // namespace zlg::trials
