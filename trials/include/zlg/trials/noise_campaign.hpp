#pragma once
// How well the fit of noise terms recovers random gyros.

#include <cstdint>
#include <string>
#include <vector>

#include <zlg/noise/noise_fit.hpp>

namespace zlg::trials {

struct NoiseCampaignTask {
    int n_gyros = 1000;
    std::int64_t n_samples = 1 << 16;
    std::uint64_t seed = 1;
    bool filters = false;  // gyros with low passes, 10 000 to a million samples each
};

// Over all gyros: errors in units of the standard errors that the fit claims.
struct TermScore {
    std::string name;
    int present = 0;
    int found = 0;  // of those
    int absent = 0;
    int false_found = 0;  // of those
    double mean = 0.0;
    double mean_square = 0.0;
    double within_1 = 0.0;  // share of the errors
    double within_2 = 0.0;
    int limits = 0;  // of the records in which it was not found
    int limits_hold = 0;
};

struct NoiseCampaign {
    std::vector<TermScore>
        terms;  // the seven kinds, then the time of the Markov term and the frequency of the sinusoid
    TermScore bandwidth{.name = "bandwidth"};
    int bandwidths_within_10 = 0;  // per cent of the truth
    double low_probability = 0.0;  // share of fits whose goodness was below 0.05
};

// Each gyro has angle random walk and each other term with a chance of one half, but bias instability and a Markov
// term, which few data tell apart, not together. Sizes are random, so that a term that is there shows: quantisation
// crosses the angle random walk between 2 and 16 samples, the rate random walk crosses it between 1/1024 and 1/64 of
// the record, the floor of the bias instability is 1.5 to 3 times the other noise there, the Markov term has 3 to 30
// times the white noise in its time, ramp and line 6 to 40 times what hides them.
//
// Gyros with low passes have one of nine or none in front of their white noise, of any rate and unit, and beside it a
// rate random walk, bias instability, both, or a rate random walk and a ramp, or none of these, each so large that the
// line of the white noise is seen over some octaves between the memory of its filter and them.
[[nodiscard]] NoiseCampaign run_noise_campaign(const NoiseCampaignTask& task);

[[nodiscard]] std::string campaign_text(const NoiseCampaign& campaign);

}  // namespace zlg::trials
