// Random gyros in random steady motions: is the sigma that is claimed for a switch true? A table in Markdown.
//
// usage: zlg_sigma_campaign [SHARE [SEED [THREADS]]]
//
// Exit 1 where a class of motion is not within .7 to 1.4, chance allowed for, or has a switch without a sigma.

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <zlg/trials/sigma_campaign.hpp>

int main(int argc, char** argv) {
    zlg::trials::SigmaTask task;
    if (argc > 1) task.share = std::atof(argv[1]);
    if (argc > 2) task.seed = std::strtoull(argv[2], nullptr, 10);
    if (argc > 3) task.threads = std::atoi(argv[3]);
    if (!(task.share > 0.0 && task.share <= 1000.0) || task.threads < 1) {
        std::fputs("usage: zlg_sigma_campaign [SHARE, over 0 to 1000 [SEED [THREADS]]]\n", stderr);
        return 2;
    }
    const auto figures = run_sigma_campaign(task);
    std::fputs(campaign_text(figures).c_str(), stdout);
    return std::ranges::all_of(figures, zlg::trials::is_true) ? 0 : 1;
}
