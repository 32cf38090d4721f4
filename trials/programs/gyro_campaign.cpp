// Random gyros without faults in closed loop: the table of what becomes of them, in Markdown.
//
// The number of threads changes no figure. A gyro of 60 to 600 s takes about a second, a laser ten. Exit 1 where
// trials::complaints has something to say; each line names the gyro with the command that runs it.

#include <map>

#include <zlg/trials/gyro_campaign.hpp>

#include "command.hpp"

int main(int argc, char** argv) {
    using namespace zlg;
    using config::Fidelity;
    trials::GyroCampaign campaign{.gyros = 300};
    std::string fidelity = "both";
    bool each = false;
    // One gyro of four is a laser, for it costs ten times as much.
    const std::map<std::string, std::vector<Fidelity>> fidelities{
        {"averaged", {Fidelity::averaged}},
        {"laser", {Fidelity::laser}},
        {"both", {Fidelity::averaged, Fidelity::averaged, Fidelity::averaged, Fidelity::laser}}};
    CLI::App app{"Random gyros without faults in closed loop", "zlg_gyro_campaign"};
    app.add_option("GYROS", campaign.gyros)->check(CLI::PositiveNumber);
    app.add_option("SEED", campaign.seed);
    app.add_option("THREADS", campaign.threads)->check(CLI::PositiveNumber);
    app.add_option("FIDELITY", fidelity, "averaged, laser, both")->check(CLI::IsMember(fidelities));
    app.add_option("--first", campaign.first, "number of the first gyro");
    app.add_flag("--each", each, "a row for each gyro");
    return trials::run_command(app, argc, argv, [&] {
        campaign.fidelities = fidelities.at(fidelity);
        const std::vector<trials::GyroOutcome> outcomes = trials::run(campaign);
        if (each) fmt::print("{}\n", trials::gyros_markdown(outcomes));
        fmt::print("{}", trials::summary_markdown(outcomes));
        const std::vector<std::string> found = trials::complaints(outcomes);
        for (const std::string& line : found) fmt::print(stderr, "zlg_gyro_campaign: {}\n", line);
        return found.empty() ? 0 : 1;
    });
}
