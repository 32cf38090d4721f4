
#include <zlg/study/fields.hpp>

#include "test.hpp"

namespace zlg::fields_test {

template <class Result> std::vector<std::string> names() {
    std::vector<std::string> all;
    study::for_each_field<Result>([&](const char* name, auto) { all.emplace_back(name); });
    return all;
}

TEST(Fields, have_the_names_of_the_members_in_the_order_of_the_list) {
    EXPECT_EQ(names<study::SwitchLine>(),
              (std::vector<std::string>{"tick", "mode", "miss_lambda", "half_wave_v", "half_wave_sigma_v", "gap_ticks",
                                        "dp_arcsec", "relock_arcsec", "sigma_arcsec", "true_error_arcsec"}));
}

TEST(Fields, are_read_from_the_result) {
    const study::SubstitutionLine line{.order = 1,
                                       .gap_ticks = 2,
                                       .frequency_hz = 3.0,
                                       .worst_arcsec = 4.0,
                                       .rms_arcsec = 5.0,
                                       .noise_gain = 6.0,
                                       .counter_arcsec = 7.0,
                                       .relock_arcsec = 8.0,
                                       .total_arcsec = 9.0};
    double expected = 0.0;
    study::for_each_field<study::SubstitutionLine>(
        [&](const char* name, auto get) { EXPECT_EQ(static_cast<double>(get(line)), ++expected) << name; });
    EXPECT_EQ(expected, 9.0);
}

TEST(Fields, may_be_lists) {
    const noise::DiscreteNoise discrete{.markov_factor = {0.5, 0.25}};
    std::vector<double> found;
    study::for_each_field<noise::DiscreteNoise>([&](const std::string& name, auto get) {
        if constexpr (std::is_same_v<std::decay_t<decltype(get(discrete))>, std::vector<double>>)
            if (name == "markov_factor") found = get(discrete);
    });
    EXPECT_EQ(found, discrete.markov_factor);
}

}  // namespace zlg::fields_test
