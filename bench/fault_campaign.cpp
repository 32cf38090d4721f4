// Random faults of every kind against the gyro in closed loop: the table of what becomes of them, in Markdown.
//
// usage: zlg_fault_campaign [FAULTS [SEED [THREADS [averaged|laser [KIND]]]]]
// The number of threads changes no figure. A laser takes 30 times as long.

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include <zlg/study/fault_campaign.hpp>

int main(int argc, char** argv) {
    using namespace zlg;
    const auto number = [&](int k, std::int64_t otherwise) { return argc > k ? std::atoll(argv[k]) : otherwise; };
    study::FaultCampaign campaign{.faults = number(1, 10'000),
                                  .seed = static_cast<std::uint64_t>(number(2, 1)),
                                  .threads = static_cast<int>(number(3, 2))};
    if (argc > 4 && std::string_view{argv[4]} == "laser") campaign.fidelity = config::Fidelity::laser;
    for (const twin::FaultKind kind : twin::all_fault_kinds()) {
        if (argc > 5 && twin::facts(kind).name == std::string_view{argv[5]}) campaign.kinds = {kind};
    }
    fmt::print("{}", study::markdown(study::run(campaign)));
    return 0;
}
