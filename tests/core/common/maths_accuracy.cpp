// The core's elementary functions against MPFR: each below one unit in the last place on 10^6 points.
//
// Compiled where MPFR is installed.

#include <gtest/gtest.h>

#include <algorithm>
#include <ios>
#include <ostream>
#include <string>

#include "mathematics/errors.hpp"

namespace zlg::trials {

void PrintTo(const Region& region, std::ostream* to) { *to << region.function.name << ": " << region.points; }

}  // namespace zlg::trials

namespace {

using namespace zlg::trials;

class MathsAccuracy : public testing::TestWithParam<Region> {};

TEST_P(MathsAccuracy, IsBelowOneUnitInTheLastPlace) {
    const Region& region = GetParam();
    const auto n_regions =
        std::ranges::count(regions(), region.function.name, [](const Region& r) { return r.function.name; });
    const WorstError worst = worst_error(region, 1'000'000 / static_cast<int>(n_regions));
    EXPECT_LT(worst.ulps, 1.0) << std::hexfloat << worst.at.x << ", " << worst.at.y;
    EXPECT_GT(worst.ulps, 0.0);
}

std::string name_of(const testing::TestParamInfo<Region>& info) {
    std::string name{info.param.function.name};
    name.append("_").append(info.param.points);
    std::ranges::replace_if(
        name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Every, MathsAccuracy, testing::ValuesIn(regions()), name_of);

}  // namespace
