// The magnetic estimator on bases that move, in Markdown.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include <zlg/trials/magnetic_gate.hpp>

#include "command.hpp"

namespace {

using namespace zlg::trials;

// Root mean squares over the runs; of single runs the worst. A run is bad where the estimator adds more than a fifth to
// the error.
struct Row {
    double without_sq = 0.0, with_sq = 0.0, error_sq = 0.0, trust = 0.0;
    double worst_ratio = 0.0;
    int n = 0, n_bad = 0;

    void add(const GateResult& r) {
        const double ratio = r.with_arcsec / r.without_arcsec;
        without_sq += r.without_arcsec * r.without_arcsec;
        with_sq += r.with_arcsec * r.with_arcsec;
        error_sq += r.error_arcsec_s * r.error_arcsec_s;
        trust += r.trust;
        worst_ratio = std::max(worst_ratio, ratio);
        ++n;
        n_bad += ratio > 1.2;
    }
};

void print(const std::string& name, const Row& r) {
    fmt::print("| {} | {:.2f} | {:.2f} | {:.3f} | {:.2f} | {:.3f} | {:.3f} | {} |\n", name,
               std::sqrt(r.without_sq / r.n), std::sqrt(r.with_sq / r.n), std::sqrt(r.with_sq / r.without_sq),
               r.worst_ratio, std::sqrt(r.error_sq / r.n), r.trust / r.n, r.n_bad);
}

}  // namespace

int main(int argc, char** argv) {
    MagneticGate gate;
    int seeds = 10;
    std::string only;
    CLI::App app{"The magnetic estimator on bases that move", "zlg_magnetic_gate"};
    app.add_option("INTERVAL_S", gate.interval_s)->check(CLI::PositiveNumber);
    app.add_option("RUN_S", gate.run_s)->check(CLI::PositiveNumber);
    app.add_option("SEEDS", seeds)->check(CLI::PositiveNumber);
    using zlg::core::FirstSegment;
    using zlg::core::ScheduleKind;
    const std::map<std::string, ScheduleKind> kinds{{"fixed", ScheduleKind::fixed},
                                                    {"measured", ScheduleKind::measured}};
    const std::map<std::string, FirstSegment> firsts{{"full", FirstSegment::full}, {"half", FirstSegment::half}};
    app.add_option("--schedule", gate.schedule)->transform(CLI::CheckedTransformer(kinds));
    app.add_option("--longest", gate.longest_s, "longest interval of a schedule that is not fixed, s")
        ->check(CLI::PositiveNumber);
    app.add_option("--first-segment", gate.first_segment)->transform(CLI::CheckedTransformer(firsts));
    app.add_option("--count", gate.count_arcsec, "arcsec a count; small: by phase")->check(CLI::PositiveNumber);
    app.add_option("--drift", gate.estimator.presumed_arcsec_s, "as calibrated, arcsec/s");
    app.add_option("--drift-sigma", gate.estimator.presumed_sigma_arcsec_s)->check(CLI::NonNegativeNumber);
    app.add_option("--thermal", gate.estimator.warming_arcsec_s, "as calibrated, arcsec/s");
    app.add_option("--thermal-sigma", gate.estimator.warming_sigma_arcsec_s)->check(CLI::NonNegativeNumber);
    app.add_option("--only", only, "bases whose name contains this");
    return run_command(app, argc, argv, [&] {
        fmt::print(
            "| base | without, arcsec rms | with | ratio | of the worst run | error of the drift, arcsec/s | trust "
            "| runs above 1.2 |\n"
            "|---|---|---|---|---|---|---|---|\n");
        for (const MovingBase& base : moving_bases(gate)) {
            if (base.name.find(only) == std::string::npos) continue;
            Row row;
            for (int seed = 1; seed <= seeds; ++seed) row.add(judge(gate, base, static_cast<std::uint64_t>(seed)));
            print(base.name, row);
        }
        return 0;
    });
}
