// One deviation of a record in a file, timed: what bench/allan compares with NumPy.
//
// usage: zlg_allan FILE KIND TAUS_PER_DECADE THREADS
//
// FILE: rates as doubles lie in memory. TAUS_PER_DECADE: 0 for octaves. Printed is JSON: seconds of the clock and of
// the processor from the numbers in memory to the curve, the most memory of the process, and the curve.

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <zlg/deviations/averaging.hpp>
#include <zlg/deviations/deviation.hpp>

namespace {

using namespace zlg::deviations;

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// With room for the one angle more that they are summed into.
std::vector<double> rates_of(const std::string& path) {
    std::vector<double> values;
    const auto n = std::filesystem::file_size(path) / sizeof(double);
    values.reserve(n + 1);
    values.resize(n);
    std::ifstream{path, std::ios::binary}.read(reinterpret_cast<char*>(values.data()),
                                               static_cast<std::streamsize>(n * sizeof(double)));
    return values;
}

// Of this program alone: rusage would count what the process that started it held.
double peak_mb() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (word == "VmHWM:" && status >> word) return std::stod(word) * 1024e-6;
    return 0.0;
}

void measure(const std::string& path, DeviationKind kind, int taus_per_decade, int threads) {
    std::vector<double> rates = rates_of(path);
    const auto largest = largest_factor(kind, static_cast<std::int64_t>(rates.size())) * 2 / 3;
    const auto factors = taus_per_decade == 0 ? octave_factors(largest) : log_factors(taus_per_decade, largest);
    const double start_s = now_s();
    const AngleRecord record({DataKind::rate, Unit::one, 200.0}, std::move(rates));
    const DeviationCurve curve = deviation(record, kind, factors, {.threads = threads});
    fmt::print("{{\"compute_s\": {:.4f}, \"processor_s\": {:.4f}, \"peak_mb\": {:.1f}, \"curve\": [", now_s() - start_s,
               processor_s(), peak_mb());
    for (const auto& point : curve.points)
        fmt::print("{}[{}, {:.17g}]", &point == &curve.points.front() ? "" : ", ", point.m, point.deviation);
    fmt::print("]}}\n");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 5) {
        fmt::print(stderr, "usage: zlg_allan FILE KIND TAUS_PER_DECADE THREADS\n");
        return 2;
    }
    measure(argv[1], deviation_kind_of(argv[2]), std::atoi(argv[3]), std::atoi(argv[4]));
    return 0;
}
