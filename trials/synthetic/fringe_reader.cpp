#include "fringe_reader.hpp"

#include <cmath>
#include <numbers>

#include <zlg/core/common/maths_kernels.hpp>

namespace zlg::trials {
namespace {

constexpr double range = 2.0;
constexpr double turn_rad = 2.0 * std::numbers::pi;

double step_of(const PhotodiodeLaw& law) { return std::ldexp(2.0 * range, -law.adc_bits); }

double noise_turns(const PhotodiodeLaw& law) {
    return std::sqrt(law.noise * law.noise + step_of(law) * step_of(law) / 12.0) / turn_rad;
}

std::int64_t whole(double phase_counts) { return static_cast<std::int64_t>(std::floor(phase_counts)); }

}  // namespace

FringeReader::FringeReader(const PhotodiodeLaw& law, double phase_counts)
    : law_{law},
      config_{.reads = law.reads, .limit = 0.999 * range, .noise_turns = noise_turns(law)},
      state_{},
      counter_{whole(phase_counts)},
      reading_counts_{static_cast<double>(counter_)} {}

void FringeReader::learn(chance::Draw& draw) {
    constexpr int halves = 8192;
    for (int k = 0; k < halves; ++k) {
        core::FringeReadoutInput in = sample(draw.uniform(), draw);
        in.settled = true;
        in.sign = k % 2 == 0 ? 1 : -1;
        static_cast<void>(step(config_, state_, in));
    }
}

double FringeReader::converted(double value) const {
    const double step = step_of(law_);
    return std::fmin(std::fmax(step * (std::floor(value / step) + 0.5), -range), range);
}

core::FringeReadoutInput FringeReader::sample(double phase_counts, chance::Draw& draw) const {
    const double place = phase_counts - std::floor(phase_counts);
    const double c = law_.offset_cosine + core::maths::sincos_turns_kernel(place).cos + law_.noise * draw.normal();
    const double s =
        law_.offset_sine +
        (1.0 + law_.amplitude_error) * core::maths::sincos_turns_kernel(place + law_.angle_error_deg / 360.0).sin +
        law_.noise * draw.normal();
    return {.present = true,
            .c = static_cast<float>(converted(c)),
            .s = static_cast<float>(converted(s)),
            .quarter = static_cast<std::uint32_t>(4.0 * place) & 3u,
            .counter = static_cast<std::uint64_t>(whole(phase_counts))};
}

FringeReading FringeReader::read(double phase_counts, int sign, bool settled, chance::Draw& draw) {
    FringeReading reading;
    std::int64_t counter = whole(phase_counts);
    reading_counts_ = static_cast<double>(counter);
    if (law_.reads) {
        core::FringeReadoutInput in = sample(phase_counts, draw);
        in.settled = settled;
        in.sign = sign;
        const core::FringeReadoutOutput out = step(config_, state_, in);
        counter = static_cast<std::int64_t>(out.counter);
        reading.fringe = out.fringe;
        const bool known = out.fringe >= 0.0f;
        reading_counts_ =
            static_cast<double>(counter) + (known ? static_cast<double>(out.fringe) / core::count_parts : 0.5);
    }
    reading.counts = counter - counter_;
    counter_ = counter;
    return reading;
}

// A sample of noise alone, as of a beat that is not there.
void FringeReader::lose(double phase_counts, chance::Draw& draw) {
    counter_ = whole(phase_counts);
    reading_counts_ = static_cast<double>(counter_) + (law_.reads ? 0.5 : 0.0);
    if (!law_.reads) return;
    core::FringeReadoutInput in = sample(phase_counts, draw);
    in.c = static_cast<float>(converted(law_.offset_cosine + law_.noise * draw.normal()));
    in.s = static_cast<float>(converted(law_.offset_sine + law_.noise * draw.normal()));
    counter_ = static_cast<std::int64_t>(step(config_, state_, in).counter);
}

}  // namespace zlg::trials
