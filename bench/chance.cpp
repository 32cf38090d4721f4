// Normal deviates by address against those of a stream: Boost's Mersenne twister and its ziggurat, the usual choice.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <fmt/format.h>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <zlg/chance/address.hpp>

#include "paired.hpp"

namespace {

using namespace zlg;

constexpr std::size_t n_deviates = 16'000'000;
constexpr std::size_t of_half = 32;
constexpr double max_ratio = 1.0;
volatile double sink = 0.0;  // what is computed must not be left out

void draw_of_stream() {
    boost::random::mt19937_64 engine{1};
    boost::random::normal_distribution<double> normal;
    double sum = 0.0;
    for (std::size_t k = 0; k < n_deviates; ++k) sum += normal(engine);
    sink = sum;
}

void draw_by_address(std::size_t at_once) {
    chance::Address address{.seed = 1, .cause = chance::Cause::benchmark};
    std::array<double, of_half> deviates{};
    double sum = 0.0;
    for (std::size_t k = 0; k < n_deviates; k += at_once, ++address.half) {
        normals(address, std::span{deviates}.first(at_once));
        sum += deviates[0];
    }
    sink = sum;
}

double measure(std::size_t at_once) {
    const auto result = bench::paired(
        9, [&] { draw_by_address(at_once); }, draw_of_stream);
    fmt::print(
        "{:>2} deviates of an address at once: {:5.2f} ns each, of a stream {:.2f} ns; ratio {:.2f} ({:.2f}..{:.2f})\n",
        at_once, 1e9 * result.work_s / n_deviates, 1e9 * result.reference_s / n_deviates, result.ratio,
        result.min_ratio, result.max_ratio);
    return result.ratio;
}

}  // namespace

int main() {
    for (const std::size_t at_once : std::array<std::size_t, 3>{1, 4, 16}) measure(at_once);
    const double ratio = measure(of_half);
    fmt::print("allowed: {:.1f} times as long with {} at once\n", max_ratio, of_half);
    return ratio <= max_ratio ? 0 : 1;
}
