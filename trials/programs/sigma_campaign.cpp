// Random gyros in random steady motions: is the sigma that is claimed for a switch true? A table in Markdown.
//
// Exit 1 where, for a class of motion, the mean square of error over sigma is outside .25 to 1.4 by more than chance,
// or a switch has no sigma.

#include <algorithm>

#include <zlg/trials/sigma_campaign.hpp>

#include "command.hpp"

int main(int argc, char** argv) {
    zlg::trials::SigmaTask task;
    CLI::App app{"Standard deviation claimed for a switch against its error", "zlg_sigma_campaign"};
    app.add_option("SHARE", task.share, "times the usual number of gyros")->check(CLI::Range(1e-6, 1000.0));
    app.add_option("SEED", task.seed, "of the random numbers");
    app.add_option("THREADS", task.threads, "to run on")->check(CLI::PositiveNumber);
    return zlg::trials::run_command(app, argc, argv, [&] {
        const auto figures = run_sigma_campaign(task);
        fmt::print("{}", campaign_text(figures));
        return std::ranges::all_of(figures, zlg::trials::is_true) ? 0 : 1;
    });
}
