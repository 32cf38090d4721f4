// One deviation of a record in a file, timed: what bench/allan compares with NumPy.
//
// usage: zlg_allan FILE KIND TAUS_PER_DECADE THREADS memory|stream
//        zlg_allan FILE.h5 write SAMPLES
//
// FILE: rates as doubles lie in memory, or an angle log, .csv or .h5. TAUS_PER_DECADE: 0 for octaves. memory: the
// numbers are read, then summed in their place; stream: they go through DeviationStream as they are read. Printed is
// JSON: seconds after and with reading, the most memory of the process, and the curve. write: an angle log of white
// noise.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <zlg/deviations/angle_samples.hpp>
#include <zlg/deviations/averaging.hpp>
#include <zlg/deviations/deviation.hpp>
#include <zlg/logs/angle_log.hpp>

namespace {

using namespace zlg;
using namespace zlg::deviations;

constexpr double tick_s = 0.005;

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

bool is_log(const std::string& path) { return path.ends_with(".h5") || path.ends_with(".csv"); }

// Doubles without a header.
AngleSamples raw_samples(const std::string& path) {
    const auto file = std::make_shared<std::ifstream>(path, std::ios::binary);
    if (!*file) throw std::runtime_error(fmt::format("{}: cannot be read", path));
    return {.what = {DataKind::rate, Unit::one, 1.0 / tick_s},
            .source = [file](std::span<double> values, std::span<std::uint8_t> valid) {
                file->read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
                std::ranges::fill(valid, std::uint8_t{1});
                return static_cast<std::size_t>(file->gcount()) / sizeof(double);
            }};
}

AngleSamples samples_of(const std::string& path) { return is_log(path) ? angle_samples(path) : raw_samples(path); }

// How long a log is it does not say before it has been read.
std::int64_t count(const std::string& path) {
    if (!is_log(path)) return static_cast<std::int64_t>(std::filesystem::file_size(path) / sizeof(double));
    logs::AngleIncrements log(path, logs::AngleColumn::dtheta_final);
    std::vector<double> values(65536);
    std::vector<std::uint32_t> flags(65536);
    std::int64_t all = 0;
    while (const auto n = log.read(values, flags)) all += static_cast<std::int64_t>(n);
    return all;
}

struct Task {
    std::string path;
    DeviationKind kind;
    int taus_per_decade, threads;
    std::int64_t n;
};

std::vector<std::int64_t> factors_of(const Task& task) {
    const auto largest = largest_factor(task.kind, task.n) * 2 / 3;
    return task.taus_per_decade == 0 ? octave_factors(largest) : log_factors(task.taus_per_decade, largest);
}

DeviationCurve in_memory(const Task& task, double& read_s) {
    const auto samples = samples_of(task.path);
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(task.n) + 1);
    values.resize(static_cast<std::size_t>(task.n));
    std::vector<std::uint8_t> valid(65536);
    for (std::size_t at = 0; at < values.size();) {
        const auto room = std::span(values).subspan(at, std::min(valid.size(), values.size() - at));
        at += samples.source(room, std::span(valid).first(room.size()));
    }
    read_s = now_s();
    const AngleRecord record(samples.what, std::move(values));
    return deviation(record, task.kind, factors_of(task), {.threads = task.threads});
}

DeviationCurve streamed(const Task& task) {
    const auto samples = samples_of(task.path);
    DeviationStream stream({.what = samples.what, .kinds = {task.kind}, .factors = factors_of(task)});
    read_into(stream, samples.source);
    return stream.curve(task.kind);
}

// Of this program alone: rusage would count what the process that started it held.
double peak_mb() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (word == "VmHWM:" && status >> word) return std::stod(word) * 1024e-6;
    return 0.0;
}

void print(const DeviationCurve& curve, double compute_s, double all_s) {
    fmt::print("{{\"compute_s\": {:.4f}, \"all_s\": {:.4f}, \"processor_s\": {:.4f}, \"peak_mb\": {:.1f}, \"curve\": [",
               compute_s, all_s, processor_s(), peak_mb());
    for (std::size_t k = 0; k < curve.points.size(); ++k)
        fmt::print("{}[{}, {:.17g}, {}]", k == 0 ? "" : ", ", curve.points[k].m, curve.points[k].deviation,
                   curve.points[k].terms);
    fmt::print("]}}\n");
}

void write(const std::string& path, std::int64_t n) {
    logs::AngleWriter writer(path, tick_s, {}, true);
    std::mt19937_64 engine(1);
    std::normal_distribution<double> normal;
    for (std::int64_t k = 0; k < n; ++k) {
        const double angle = normal(engine);
        writer.write({.tick = k, .dtheta_arcsec = angle, .dtheta_final_arcsec = angle});
    }
    writer.close();
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc == 4 && std::string(argv[2]) == "write") {
            write(argv[1], std::atoll(argv[3]));
            return 0;
        }
        if (argc != 6) {
            fmt::print(stderr, "usage: zlg_allan FILE KIND TAUS_PER_DECADE THREADS memory|stream\n");
            return 2;
        }
        const Task task{.path = argv[1],
                        .kind = deviation_kind_of(argv[2]),
                        .taus_per_decade = std::atoi(argv[3]),
                        .threads = std::atoi(argv[4]),
                        .n = count(argv[1])};
        const double start = now_s();
        double read_s = start;
        const auto curve = std::string(argv[5]) == "stream" ? streamed(task) : in_memory(task, read_s);
        const double end = now_s();
        print(curve, end - read_s, end - start);
    } catch (const std::exception& error) {
        fmt::print(stderr, "zlg_allan: {}\n", error.what());
        return 3;
    }
    return 0;
}
