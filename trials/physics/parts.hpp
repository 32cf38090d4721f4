#pragma once

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>
#include <zlg/trials/physics_pictures.hpp>

namespace zlg::trials {

void add_waves(PhysicsPictures& made);
void add_bias(PhysicsPictures& made);
void add_discriminator(PhysicsPictures& made);
void add_field(PhysicsPictures& made);
void add_lock_in(PhysicsPictures& made);
void add_switch(PhysicsPictures& made);
void add_piezo(PhysicsPictures& made);
void add_misses(PhysicsPictures& made);

using report::add_point;
using report::blank_series;
using report::Mark;

// f at from, from + step, ... of n + 1 places.
template <class Function>
void sample(report::Series& series, double from, double step, int n, const Function& f) {
    for (int k = 0; k <= n; ++k) add_point(series, from + step * k, f(from + step * k));
}

inline void read(PhysicsPictures& made, std::string quantity, const std::vector<double>& values, int decimals,
                 std::string unit = "") {
    std::string text;
    for (const double value : values) text += fmt::format("{}{:.{}f}", text.empty() ? "" : ", ", value, decimals);
    made.readings.push_back({std::move(quantity), std::move(text), std::move(unit)});
}

}  // namespace zlg::trials
