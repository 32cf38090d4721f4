
#include <zlg/study/term_text.hpp>

#include "test.hpp"

namespace zlg::term_text_test {

using noise::NoiseKind;

TEST(TermText, a_value_has_the_digits_that_its_error_allows) {
    EXPECT_EQ(study::with_error(1.23456, 0.012), "1.235 +- 0.012");
    EXPECT_EQ(study::with_error(-12.3, 1.6), "-12.3 +- 1.6");
    EXPECT_EQ(study::with_error(1234.5, 160.0), "1.23e+03 +- 1.6e+02");
    EXPECT_EQ(study::with_error(1.23456e-6, 1.2e-8), "1.235e-06 +- 1.2e-08");
    EXPECT_EQ(study::with_error(1.5, std::numeric_limits<double>::infinity()), "1.5");
    EXPECT_EQ(study::with_error(std::numeric_limits<double>::quiet_NaN(), 1.0), "none");
}

TEST(TermText, terms_stand_in_the_units_of_data_sheets) {
    // 0.12 arcsec/sqrt(s) = 0.002 deg/sqrt(h)
    EXPECT_EQ(study::value_text({.kind = NoiseKind::angle_random_walk, .found = true, .value = 0.12, .sigma = 0.006}),
              "0.00200 +- 0.00010 deg/sqrt(h)");
    EXPECT_EQ(study::value_text({.kind = NoiseKind::angle_random_walk,
                                 .found = true,
                                 .value = 0.12,
                                 .sigma = 0.006,
                                 .second = 20.0,
                                 .second_sigma = 0.5}),
              "0.00200 +- 0.00010 deg/sqrt(h), bandwidth 20.00 +- 0.50 Hz");
    EXPECT_EQ(study::value_text({.kind = NoiseKind::ramp, .limit = 1e-4}), "below 0.36 deg/h/h");
    EXPECT_EQ(study::value_text({.kind = NoiseKind::sine}), "not found");
    EXPECT_EQ(study::value_text({.kind = NoiseKind::markov,
                                 .found = true,
                                 .value = 2.0,
                                 .sigma = 0.1,
                                 .second = 60.0,
                                 .second_sigma = 5.0}),
              "2.00 +- 0.10 deg/h, time 60.0 +- 5.0 s");
    EXPECT_EQ(study::shown_term(NoiseKind::rate_random_walk).factor, 60.0);
}

TEST(TermText, an_estimate_has_its_error_or_says_why_there_is_none) {
    EXPECT_EQ(study::value_text(numeric::estimated(1.23456, 0.012), "deg/h"), "1.235 +- 0.012 deg/h");
    EXPECT_EQ(study::value_text(numeric::refused("one mode"), "deg/h"), "not determined: one mode");
}

}  // namespace zlg::term_text_test
