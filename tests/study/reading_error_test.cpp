#include <zlg/study/reading_error.hpp>

#include "test.hpp"

namespace zlg::study::reading_error_test {

config::Config gyro(config::Readout readout) {
    config::Config config;
    config.gyro.scale_arcsec = 4.0;
    config.gyro.readout = readout;
    return config;
}

rig::LoopHalf half(double rounding_arcsec, float fringe) {
    rig::LoopHalf out;
    out.truth.rounding_arcsec = rounding_arcsec;
    out.record.fringe = fringe;
    return out;
}

TEST(ReadingError, OfCountsIsTheRoundingOfTheCounter) {
    EXPECT_EQ(reading_error_arcsec(gyro(config::Readout::counts), half(-2.1, 32768.0f)), -2.1);
}

TEST(ReadingError, OfThePhaseIsThatOfCountAndPlaceTogether) {
    // Half a count of 4 arcsec, and the counter 2.1 arcsec below the phase.
    EXPECT_NEAR(reading_error_arcsec(gyro(config::Readout::phase), half(-2.1, 32768.0f)), -0.1, 1e-12);
}

TEST(ReadingError, IsTakenModuloACountWherePlaceAndCountLieOnDifferentSidesOfABorder) {
    EXPECT_NEAR(reading_error_arcsec(gyro(config::Readout::phase), half(-0.05, 65536.0f * 0.9875f)), -0.1, 1e-5);
}

TEST(ReadingError, WithoutAPlaceIsThatOfTheMiddleOfTheCount) {
    EXPECT_EQ(reading_error_arcsec(gyro(config::Readout::phase), half(-3.0, __builtin_nanf(""))), -1.0);
}

TEST(ReadingError, OfALaserIsNotKnownAndStaysAsTheTwinSays) {
    config::Config config = gyro(config::Readout::phase);
    config.gyro.fidelity = config::Fidelity::laser;
    EXPECT_EQ(reading_error_arcsec(config, half(0.0, 100.0f)), 0.0);
}

}  // namespace zlg::study::reading_error_test
