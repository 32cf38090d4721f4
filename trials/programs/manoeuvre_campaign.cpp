// First manoeuvres at a gap: the error of the estimate beside the best polynomial of each family, as a table to stdout.
//
// usage: zlg_manoeuvre_campaign [GAPS] [--quick | --members] [--seed N] [--threads N]

#include <algorithm>

#include <zlg/trials/accuracy.hpp>

#include "command.hpp"

namespace {

using namespace zlg;

int run(int gaps, bool quick, std::uint64_t seed, int threads) {
    fmt::print("| base | manoeuvre | auto, \" | best polynomial, \" | auto/best | NEV | within 3 sigma, % |\n");
    for (const trials::ManoeuvreFigures& f : trials::measure_manoeuvres(gaps, quick, seed, threads)) {
        double best = 1e300;
        for (const trials::MethodFigures& m : f.methods)
            if (m.of_paper) best = std::min(best, m.whole.rms_arcsec);
        const trials::ErrorFigures& a = f.methods[0].whole;
        fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} |\n", f.base, f.manoeuvre, a.rms_arcsec,
                   best, a.rms_arcsec / best, a.nev, 100.0 * a.within_3_sigma_ratio);
    }
    return 0;
}

// What is left of the error when a member of the bank is taken out: rms without it over rms with all.
int run_members(int gaps, std::uint64_t seed, int threads) {
    const std::vector<trials::ManoeuvreFigures> all = trials::measure_members(gaps, seed, threads);
    const auto print = [&](const char* what, bool first) {
        for (std::size_t m = 1; m < all.front().methods.size(); ++m) {
            std::vector<std::pair<double, std::string>> ratio;
            for (const trials::ManoeuvreFigures& f : all)
                if ((f.manoeuvre == "first gap") == first)
                    ratio.emplace_back(f.methods[m].whole.rms_arcsec / f.methods[0].whole.rms_arcsec,
                                       fmt::format("{}, {}", f.base, f.manoeuvre.empty() ? "nothing" : f.manoeuvre));
            std::sort(ratio.begin(), ratio.end());
            fmt::print("| {} | {} | {:.2f} ({}) | {:.2f} | {:.2f} ({}) |\n", what, m, ratio.front().first,
                       ratio.front().second, ratio[ratio.size() / 2].first, ratio.back().first, ratio.back().second);
        }
    };
    fmt::print("| gaps | without member | least ratio | median | largest |\n");
    print("known motion", false);
    print("first gaps", true);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    int gaps = 500;
    bool quick = false, members = false;
    std::uint64_t seed = 1;
    int threads = 2;
    CLI::App app{"First manoeuvres at a gap", "zlg_manoeuvre_campaign"};
    app.add_option("GAPS", gaps, "of each family")->check(CLI::PositiveNumber);
    app.add_flag("--quick", quick, "the main families only");
    app.add_flag("--members", members, "what each member of the bank of the estimate buys");
    app.add_option("--seed", seed);
    app.add_option("--threads", threads)->check(CLI::PositiveNumber);
    return trials::run_command(
        app, argc, argv, [&] { return members ? run_members(gaps, seed, threads) : run(gaps, quick, seed, threads); });
}
