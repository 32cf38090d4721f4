// Gyros by halves and from event to event.

#include <memory>

#include <fmt/format.h>

#include <zlg/trials/event_campaign.hpp>

#include "campaigns.hpp"

namespace zlg::trials {

// 60 gyros, 16 runs either way: ten minutes of a core, nearly all for the halves.
Work events(CLI::App& app) {
    const auto campaign = std::make_shared<EventCampaign>(EventCampaign{.threads = 2});
    app.add_option("GYROS", campaign->gyros)->check(CLI::PositiveNumber);
    app.add_option("--runs", campaign->runs, "of a gyro, either way")->check(CLI::Range(3, 1000));
    app.add_option("--switches", campaign->switches, "of a run, about")->check(CLI::PositiveNumber);
    app.add_option("--longest", campaign->longest_s, "s, of a run")->check(CLI::PositiveNumber);
    add_seed_and_threads(app, *campaign);
    return [campaign] {
        const std::vector<EventFigures> figures = run(*campaign);
        fmt::print("{}", markdown(figures));
        const std::string beyond = complaint(figures);
        if (!beyond.empty()) fmt::print("\n{}\n", beyond);
        return beyond.empty() ? 0 : 1;
    };
}

}  // namespace zlg::trials
