#pragma once
// Errors of the core's elementary functions against MPFR, on points that are hard for each.

#include <random>
#include <string_view>
#include <vector>

#include <mpfr.h>

namespace zlg::trials {

// The second argument of a function of one is not used.
struct Arguments {
    double x = 0.0;
    double y = 0.0;
};

using Bits = std::mt19937_64;  // the language says what it gives

struct Function {
    std::string_view name;
    double (*computed)(Arguments);
    int (*exact)(mpfr_ptr result, mpfr_srcptr x, mpfr_srcptr y);
};

// A function on one kind of points.
struct Region {
    Function function;
    std::string_view points;
    Arguments (*draw)(Bits&);
};

// Every function of zlg/core/common/maths.hpp, each in several regions.
const std::vector<Region>& regions();

struct WorstError {
    double ulps = 0.0;  // units in the last place of the exact value as a double; infinite where a NaN came out
    Arguments at;
};

// The largest error on n_points points of a fixed seed.
WorstError worst_error(const Region& region, int n_points);

}  // namespace zlg::trials
