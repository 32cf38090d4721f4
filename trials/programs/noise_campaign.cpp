// Random gyros, simulated and fitted: are the terms found with the errors that are claimed? A table in Markdown.

#include <zlg/trials/noise_campaign.hpp>

#include "command.hpp"

int main(int argc, char** argv) {
    zlg::trials::NoiseCampaignTask task;
    CLI::App app{"Noise terms of random gyros, simulated and fitted", "zlg_noise_campaign"};
    app.add_option("GYROS", task.n_gyros)->check(CLI::PositiveNumber);
    app.add_option("SAMPLES", task.n_samples)->check(CLI::Range(4096.0, 1e9));
    app.add_option("SEED", task.seed);
    return zlg::trials::run_command(app, argc, argv, [&] {
        fmt::print("{}", campaign_text(run_noise_campaign(task)));
        return 0;
    });
}
