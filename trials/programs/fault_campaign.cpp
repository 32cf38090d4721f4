// Random faults of every kind against the gyro in closed loop: the table of what becomes of them, in Markdown.
//
// The number of threads changes no figure. A laser takes 30 times as long. Exit 1 where trials::complaints has
// something to say: a gyro that does not recover, a NaN, a crash, too few valid ticks, a sigma that is not true.

#include <map>

#include <zlg/trials/fault_campaign.hpp>

#include "command.hpp"

int main(int argc, char** argv) {
    using namespace zlg;
    trials::FaultCampaign campaign{.faults = 10'000, .threads = 2};
    const std::map<std::string, config::Fidelity> fidelities{{"averaged", config::Fidelity::averaged},
                                                             {"laser", config::Fidelity::laser}};
    std::map<std::string, twin::FaultKind> kinds;
    for (const twin::FaultKind kind : twin::all_fault_kinds) kinds.emplace(twin::facts(kind).name, kind);
    CLI::App app{"Random faults against the gyro in closed loop", "zlg_fault_campaign"};
    app.add_option("FAULTS", campaign.faults)->check(CLI::PositiveNumber);
    app.add_option("SEED", campaign.seed);
    app.add_option("THREADS", campaign.threads)->check(CLI::PositiveNumber);
    app.add_option("FIDELITY", campaign.fidelity)->transform(CLI::CheckedTransformer(fidelities));
    app.add_option("KIND", campaign.kinds, "of docs/faults.md")->transform(CLI::CheckedTransformer(kinds));
    return trials::run_command(app, argc, argv, [&] {
        const std::vector<trials::FaultFigures> figures = trials::run(campaign);
        fmt::print("{}", trials::markdown(figures));
        const std::vector<std::string> found = trials::complaints(figures);
        for (const std::string& line : found) fmt::print(stderr, "zlg_fault_campaign: {}\n", line);
        return found.empty() ? 0 : 1;
    });
}
