// Random faults of every kind against the gyro in closed loop: the table of what becomes of them, in Markdown.
//
// usage: zlg_fault_campaign [FAULTS [SEED [THREADS [averaged|laser [KIND]]]]]
// The number of threads changes no figure. A laser takes 30 times as long. Exit 1 where trials::complaints has something to
// say: a gyro that does not recover, a NaN, a crash, too few valid ticks, a sigma that is not true.

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <zlg/trials/fault_campaign.hpp>

int main(int argc, char** argv) {
    using namespace zlg;
    const auto number = [&](int k, std::int64_t otherwise) { return argc > k ? std::atoll(argv[k]) : otherwise; };
    trials::FaultCampaign campaign{.faults = number(1, 10'000),
                                   .seed = static_cast<std::uint64_t>(number(2, 1)),
                                   .threads = static_cast<int>(number(3, 2))};
    if (argc > 4 && std::string_view{argv[4]} == "laser") campaign.fidelity = config::Fidelity::laser;
    for (const twin::FaultKind kind : twin::all_fault_kinds) {
        if (argc > 5 && twin::facts(kind).name == std::string_view{argv[5]}) campaign.kinds = {kind};
    }
    if (campaign.faults < 1 || campaign.threads < 1 || (argc > 5 && campaign.kinds.empty())) {
        fmt::print(stderr,
                   "zlg_fault_campaign: allowed are 1 or more FAULTS and THREADS, and a KIND of docs/faults.md\n");
        return 2;
    }
    const std::vector<trials::FaultFigures> figures = trials::run(campaign);
    fmt::print("{}", trials::markdown(figures));
    const std::vector<std::string> found = trials::complaints(figures);
    for (const std::string& line : found) fmt::print(stderr, "zlg_fault_campaign: {}\n", line);
    return found.empty() ? 0 : 1;
}
