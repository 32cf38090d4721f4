#pragma once
// Deviations of a stream of any length in bounded memory: live, or from a log that does not fit.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <zlg/deviations/deviation.hpp>

namespace zlg::deviations {

struct StreamConfig {
    SeriesKind what;
    std::vector<DeviationKind> kinds;   // of oadev, mdev, tdev, ohdev
    std::vector<std::int64_t> factors;  // an averaging m > window is rounded to a multiple of its stride
    std::int64_t window = 1 << 14;      // 64 .. 2^24, a power of two: longest averaging of which every start is used
    double least_known_ratio = 0.9;
};

// Averagings up to `window` use every start, so they are what `deviation` gives. Longer ones use every s-th, s the
// smallest power of two with m <= window s: at `window` starts within one averaging time the neighbours differ by next
// to nothing, and the degrees of freedom are the same.
//
// memory  about 100 bytes * window * (1 + log2(largest factor/window)), whatever the length.
class DeviationStream {
public:
    // errors  SeriesError: a value out of its range.
    explicit DeviationStream(const StreamConfig& config);
    ~DeviationStream();
    DeviationStream(DeviationStream&&) noexcept;

    // The samples that follow. errors  SeriesError: a mask of another length.
    void add(std::span<const double> values, std::span<const std::uint8_t> valid = {});

    // What is known by now. options.least_known_ratio and threads are not used.
    //
    // errors  SeriesError: a kind not asked for at the beginning, no tau with a term yet.
    [[nodiscard]] DeviationCurve curve(DeviationKind kind, const DeviationOptions& options = {}) const;

    [[nodiscard]] std::int64_t n_samples() const;
    [[nodiscard]] std::int64_t n_known() const;
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Fills both, as far as it can, and returns how many; 0 at the end.
using SampleSource = std::function<std::size_t(std::span<double> values, std::span<std::uint8_t> valid)>;

// The rest of a source, in pieces of 65536.
void read_into(DeviationStream& stream, const SampleSource& source);

}  // namespace zlg::deviations
