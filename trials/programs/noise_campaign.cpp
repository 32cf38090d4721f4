// Random gyros, simulated and fitted: are the terms found with the errors that are claimed? A table in Markdown.
//
// usage: zlg_noise_campaign [GYROS [SAMPLES [SEED]]]

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include <zlg/trials/noise_campaign.hpp>

int main(int argc, char** argv) {
    zlg::trials::NoiseCampaignTask task;
    if (argc > 1) task.n_gyros = std::atoi(argv[1]);
    if (argc > 2) task.n_samples = std::atoll(argv[2]);
    if (argc > 3) task.seed = std::strtoull(argv[3], nullptr, 10);
    if (task.n_gyros < 1 || task.n_samples < 4096) {
        std::fputs("usage: zlg_noise_campaign [GYROS [SAMPLES, 4096 or more [SEED]]]\n", stderr);
        return 2;
    }
    std::fputs(campaign_text(run_noise_campaign(task)).c_str(), stdout);
    return 0;
}
