#pragma once
// The overlapping Allan deviation of an angle that grows tick by tick, at octaves of the averaging time, in bounded
// memory.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace zlg::live {

// Averagings up to `window` ticks use every start. Longer ones use so many starts within one averaging time: the
// neighbours differ by next to nothing there.
class OctaveAllan {
public:
    static constexpr std::int64_t window = 1024;
    static constexpr int octaves = 31;

    // The angle at the end of the next tick; the first one begins at 0.
    void add(double angle_arcsec) {
        if (n_ == 0) put(0.0);
        put(angle_arcsec);
    }

    // Averaging times and deviations, as far as there is a difference.
    [[nodiscard]] std::pair<std::vector<double>, std::vector<double>> points(double tick_s) const {
        std::pair<std::vector<double>, std::vector<double>> found;
        for (std::size_t k = 0; k < sums_.size() && sums_[k].n > 0.0; ++k) {
            found.first.push_back(std::ldexp(tick_s, static_cast<int>(k)));
            found.second.push_back(std::sqrt(0.5 * sums_[k].squares / sums_[k].n) / found.first.back());
        }
        return found;
    }

private:
    static constexpr int octaves_of_ticks = 11;  // 2^10 is the window
    struct Sum {
        double squares = 0.0, n = 0.0;
    };
    // Every 2^k-th border of the ticks, the newest of them in a ring.
    struct Level {
        std::vector<double> ring = std::vector<double>(2 * window + 1);
        std::int64_t n = 0;
        [[nodiscard]] double before(std::int64_t entries) const {
            return ring[std::size_t((n - 1 - entries) % (2 * window + 1))];
        }
    };

    void put(double angle_arcsec) {
        for (std::size_t k = 0; k <= octaves - octaves_of_ticks && n_ % (std::int64_t{1} << k) == 0; ++k) {
            if (k == levels_.size()) levels_.emplace_back();
            Level& level = levels_[k];
            level.ring[static_cast<std::size_t>(level.n++ % (2 * window + 1))] = angle_arcsec;
            if (k > 0) take(level, window, k + octaves_of_ticks - 1);
            for (int octave = 0; k == 0 && octave < octaves_of_ticks; ++octave)
                take(level, std::int64_t{1} << octave, static_cast<std::size_t>(octave));
        }
        ++n_;
    }

    void take(const Level& level, std::int64_t m, std::size_t octave) {
        if (level.n <= 2 * m) return;
        if (octave >= sums_.size()) sums_.resize(octave + 1);
        const double difference = level.before(0) - 2.0 * level.before(m) + level.before(2 * m);
        sums_[octave].squares += difference * difference;
        sums_[octave].n += 1.0;
    }

    std::int64_t n_ = 0;  // borders
    std::vector<Level> levels_;
    std::vector<Sum> sums_;
};

}  // namespace zlg::live
