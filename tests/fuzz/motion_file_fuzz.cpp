// A motion file of any bytes, read in any way, is refused with a reason or is a motion whose angle adds up.

#include <cmath>
#include <stdexcept>
#include <string>

#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/rig/wiring.hpp>

#include "bytes.hpp"
#include "claim.hpp"
#include "scratch.hpp"

namespace {

using namespace zlg;
using fuzz::claim;

// The first bytes say how to read the rest.
config::Config how_to_read(fuzz::Bytes& bytes) {
    constexpr const char* comments[] = {"#", "", "//", " ", ";", "#"};
    config::Config config;
    config::Motion& file = config.motion;
    file.kind = config::MotionKind::file;
    file.column = std::to_string(bytes.index(8));
    file.column_holds = bytes.flag() ? config::ColumnHolds::rate : config::ColumnHolds::increment;
    file.skip_lines = static_cast<std::int64_t>(bytes.index(4)) - 1;
    file.comment = comments[bytes.index(6)];
    file.scale_arcsec = bytes.real(1.0);
    file.rate_hz = bytes.real(100.0);
    return config;
}

// As far as the sum of all increments is a number, so is every part of it.
void claim_adds_up(const twin::Motion& motion) {
    const double end_s = motion.duration_s();
    claim(end_s > 0.0, "a motion has a length");
    const double whole_arcsec = motion.increment_arcsec(0.0, end_s);
    const double first_arcsec = motion.increment_arcsec(0.0, 0.5 * end_s);
    const double second_arcsec = motion.increment_arcsec(0.5 * end_s, end_s);
    const double size = std::fabs(first_arcsec) + std::fabs(second_arcsec) + std::fabs(whole_arcsec);
    if (!(size < 1e300)) return;
    claim(std::fabs(first_arcsec + second_arcsec - whole_arcsec) <= 1e-9 * size, "increments add up");
    // The last row ends at rows/rate, which is rounded.
    claim(motion.increment_arcsec(1.001 * end_s, 2.0 * end_s) == 0.0, "beyond the end the case rests");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t head = 22;
    fuzz::Bytes bytes{data, std::min(size, head)};
    config::Config config = how_to_read(bytes);
    const std::size_t used = std::min(size, head);
    config.motion.path = fuzz::scratch().write("motion.txt", data + used, size - used);
    try {
        claim_adds_up(recorded::motion(config));
    } catch (const std::invalid_argument&) {
        // The rate is out of range.
    } catch (const config::ConfigError&) {
        // A column of times, or times of another rate.
    } catch (const logs::FormatError&) {
        // The text is no motion.
    }
    return 0;
}
