#include <zlg/logs/budget.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <zlg/logs/error.hpp>

namespace zlg::logs {

namespace {

constexpr std::size_t of_any_file = std::size_t{1} << 20;
constexpr std::size_t per_byte = 4;
// A sparse file has more bytes than any disk.
constexpr std::size_t of_the_largest = std::size_t{1} << 30;
constexpr std::size_t max_objects = 10'000;
constexpr std::size_t values_of_a_chunk = 32, unpacked_for_a_value = 4;

}  // namespace

Budget::Budget(std::string path, std::size_t file_bytes)
    : path_{std::move(path)},
      file_bytes_{file_bytes},
      max_values_{std::min(of_any_file + per_byte * std::min(file_bytes, of_the_largest), of_the_largest)} {}

void Budget::take_values(std::size_t rows, std::size_t columns) {
    const std::size_t left = max_values_ - n_values_;
    if (rows > left || (rows > 0 && columns > left / rows))
        throw FormatError(fmt::format(
            "{}: {} times {} values{}; allowed are {} in all, of a file of {} bytes", path_, rows, columns,
            n_values_ > 0 ? fmt::format(", and {} before", n_values_) : std::string{}, max_values_, file_bytes_));
    n_values_ += rows * columns;
}

void Budget::take_chunks(std::size_t n, std::size_t unpacked_values_of_one) {
    const std::size_t cost = std::max(values_of_a_chunk, unpacked_values_of_one / unpacked_for_a_value);
    if (n > (max_values_ - n_for_chunks_) / cost)
        throw FormatError(fmt::format(
            "{}: {} chunks that cost as much as {} values each{}; allowed are {} in all, of a file of {} bytes", path_,
            n, cost, n_for_chunks_ > 0 ? fmt::format(", and others before as {}", n_for_chunks_) : std::string{},
            max_values_, file_bytes_));
    n_for_chunks_ += n * cost;
}

void Budget::take_unpacked(std::size_t bytes) {
    const std::size_t most = sizeof(double) * max_values_;
    if (bytes > most - n_unpacked_)
        throw FormatError(fmt::format(
            "{}: unpacks to {} bytes{}; allowed are {} in all, of a file of {} bytes", path_, bytes,
            n_unpacked_ > 0 ? fmt::format(", and {} before", n_unpacked_) : std::string{}, most, file_bytes_));
    n_unpacked_ += bytes;
}

void Budget::take_object() {
    if (++n_objects_ > max_objects)
        throw FormatError(
            fmt::format("{}: more than {} groups and arrays, which is the most allowed", path_, max_objects));
}

std::int64_t max_missing_rows(std::size_t n_rows) {
    constexpr std::int64_t times = 10, in_any_case = 360'000;
    return std::max(times * static_cast<std::int64_t>(n_rows), in_any_case);
}

}  // namespace zlg::logs
