// Gaps before the motion is known, and gaps of every length once it is: error and sigma of the switch, as tables to
// stdout.
//
// usage: zlg_gap_campaign [SHARE] [--threads N]

#include <algorithm>
#include <vector>

#include <zlg/chance/draw.hpp>
#include <zlg/numeric/parallel.hpp>

#include "accuracy/parts.hpp"
#include "accuracy/statistics.hpp"
#include "accuracy/trial.hpp"
#include "command.hpp"

namespace {

using namespace zlg::trials;

struct Motion {
    const char* name;
    MotionLaw law;
};

std::vector<Motion> motions() {
    return {{"rest, up to 15 \"/s", {.rate_spread_arcsec_s = 15.0}},
            {"20.06 Hz", {.tones = {{20.06, 12000.0}}}},
            {"7.03 and 23.71 Hz", {.tones = {{7.03, 12000.0}, {23.71, 6000.0}}}},
            {"0..20 Hz, 8485 \"/s", {.bands = {{0.0, 20.0, 8485.0}}}},
            {"5..80 Hz, 8000 \"/s", {.bands = {{5.0, 80.0, 8000.0}}}},
            {"5..80 Hz, 300 \"/s", {.bands = {{5.0, 80.0, 300.0}}}}};
}

enum class Readout { counts, fine_counts, phase };
constexpr const char* readout_name[] = {"x1", "x4", "phase"};

struct Case {
    Readout readout = Readout::counts;
    int gap_ticks = 3;
    int min_start = 10, max_start = 69;
    int switches = 1;
};

void print_case(const Motion& motion, const Case& c, std::size_t gyros, int threads) {
    const std::vector<std::string> names{method_name::automatic, method_name::automatic_ticks, method_name::constant,
                                         method_name::quadratic};
    std::vector<std::vector<std::vector<SwitchError>>> found(gyros);
    zlg::numeric::in_parallel(gyros, threads, [&](std::size_t k) {
        const zlg::chance::Draws draws{.seed = static_cast<std::uint64_t>(c.min_start + c.gap_ticks),
                                       .cause = zlg::chance::Cause::gap_gyro,
                                       .trial = k};
        SwitchTrial trial{.motion = motion.law, .switches = c.switches, .interval_ticks = 600, .seed = k + 1};
        trial.gyro.gap_ticks = c.gap_ticks;
        trial.gyro.bias_hz *= 1.0 + 0.01 * draws.of("bias").uniform();
        if (c.readout == Readout::fine_counts) {
            trial.gyro.scale_arcsec /= 4.0;
            trial.gyro.bias_hz *= 4.0;
        }
        if (c.readout == Readout::phase) trial.gyro.photodiodes = {.reads = true, .learnt = true};
        trial.learn_ticks = c.min_start + static_cast<int>((c.max_start - c.min_start) * draws.of("start").uniform());
        auto config = config_of(trial.gyro);
        config.drift.random_walk_arcsec_sqrt_s = 0.0;
        found[k] = run_trial(trial, methods_for(config, names));
    });
    std::vector<ErrorFigures> figures;
    for (std::size_t m = 0; m < names.size(); ++m) {
        std::vector<SwitchError> all;
        for (const auto& gyro : found) all.insert(all.end(), gyro[m].begin(), gyro[m].end());
        figures.push_back(figures_of(all));
    }
    fmt::print("| {} | {} | {} | {}..{} | {:.3f} | {:.2f} | {:.3f} | {:.2f} | {:.3f} |\n", motion.name,
               readout_name[static_cast<int>(c.readout)], c.gap_ticks, c.min_start, c.max_start, figures[0].rms_arcsec,
               figures[0].nev, figures[1].rms_arcsec, figures[1].nev,
               std::min(figures[2].rms_arcsec, figures[3].rms_arcsec));
}

int run(double share, int threads) {
    const auto gyros = [share](double n) { return static_cast<std::size_t>(std::max(1.0, share * n)); };
    fmt::print(
        "| motion | readout | gap, ticks | begins at tick | joint, auto, \" | NEV | mean square, auto, \" | NEV | best "
        "polynomial, \" |\n|---|---|---|---|---|---|---|---|---|\n");
    const std::vector<Motion> all = motions();
    for (const Motion& motion : all)
        for (const Readout readout : {Readout::counts, Readout::fine_counts, Readout::phase})
            for (const auto& [from, to] : {std::pair{10, 69}, std::pair{70, 300}})
                print_case(motion, {.readout = readout, .min_start = from, .max_start = to}, gyros(300.0), threads);
    for (std::size_t m = 0; m < 3; ++m)
        for (const Readout readout : {Readout::counts, Readout::fine_counts, Readout::phase})
            for (int n = 1; n <= 10; ++n)
                print_case(all[m],
                           {.readout = readout, .gap_ticks = n, .min_start = 5000, .max_start = 5300, .switches = 40},
                           gyros(8.0), threads);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    double share = 1.0;
    int threads = 2;
    CLI::App app{"First gaps, and gaps of every length", "zlg_gap_campaign"};
    app.add_option("SHARE", share, "of the gyros")->check(CLI::Range(1e-6, 1000.0));
    app.add_option("--threads", threads)->check(CLI::PositiveNumber);
    return run_command(app, argc, argv, [&] { return run(share, threads); });
}
