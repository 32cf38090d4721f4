// Outer fields of random size, time and duration against gyros at rest and in a steady turn: what of their angle is left, as a table in
// Markdown. Each gyro runs with and without its field, with the same noise; what is left is the difference of both angle errors.

#include <algorithm>
#include <cmath>
#include <vector>

#include <zlg/chance/draw.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/numeric/parallel.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>

#include "command.hpp"

namespace {

using namespace zlg;

constexpr double earliest_s = 200.0;  // several segments are known by then
constexpr double end_s = 500.0;

struct Pulse {
    double at_s = 0.0, duration_s = 0.0, hz = 0.0, rate_arcsec_s = 0.0;
};

Pulse drawn(std::uint64_t seed) {
    const chance::Draws draws{.seed = seed, .cause = chance::Cause::field_pulse};
    Pulse made;
    made.at_s = draws.of("at_s").within(earliest_s, earliest_s + 90.0);
    made.duration_s = draws.of("duration_s").within_log(0.1, 60.0);
    made.hz = draws.of("sign").sign() * draws.of("hz").within(0.3, 30.0);
    if (draws.of("turns").is_one_in(2))
        made.rate_arcsec_s = draws.of("sign of the rate").sign() * draws.of("rate_arcsec_s").within_log(10.0, 1e5);
    return made;
}

struct Run {
    double error_arcsec = 0.0;
    bool switched = false;  // within the field
};

Run run(const config::Config& config, const Pulse& pulse) {
    rig::ClosedLoop loop{config, rig::motion(config)};
    rig::Replay replay{rig::asked_compensation(config)};
    double turned_arcsec = 0.0;
    double final_arcsec = 0.0;
    Run out;
    const auto add = [&](const core::AngleRow& row) { final_arcsec += row.dtheta_final_arcsec; };
    for (std::int64_t half = 0; half < std::llround(2.0 * end_s / config.gyro.tick_s); ++half) {
        const rig::LoopHalf now = loop.advance();
        turned_arcsec += now.truth.dtheta_arcsec;
        (void)replay.take(now.record, {}, add);
        const double t_s = 0.5 * static_cast<double>(half) * config.gyro.tick_s;
        out.switched |= !now.record.loop_closed && t_s > pulse.at_s && t_s < pulse.at_s + pulse.duration_s;
    }
    replay.end(add);
    out.error_arcsec = final_arcsec - turned_arcsec;
    return out;
}

struct Left {
    double arcsec = 0.0;
    bool switched = false;
};

Left left_by(config::Config config, const Pulse& pulse, std::uint64_t seed) {
    config.run.seed = seed;
    config.motion.kind = pulse.rate_arcsec_s == 0.0 ? config::MotionKind::rest : config::MotionKind::constant;
    config.motion.rate_arcsec_s = pulse.rate_arcsec_s;
    const Run without = run(config, pulse);
    config.faults.kind = {twin::FaultKind::field_pulse};
    config.faults.at_s = {pulse.at_s};
    config.faults.duration_s = {pulse.duration_s};
    config.faults.size = {pulse.hz};
    const Run with = run(config, pulse);
    return {.arcsec = with.error_arcsec - without.error_arcsec, .switched = with.switched};
}

// A row: of the fields over which the mode was switched, or of the others.
void print_row(const std::string& name, const std::vector<Left>& left, bool switched) {
    std::vector<double> sizes;
    for (const Left& one : left)
        if (one.switched == switched) sizes.push_back(std::abs(one.arcsec));
    if (sizes.empty()) return;
    std::ranges::sort(sizes);
    double sq = 0.0;
    for (const double size : sizes) sq += size * size / static_cast<double>(sizes.size());
    const auto beyond = std::ranges::count_if(sizes, [](double size) { return size > 20.0; });
    fmt::print("| {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {} |\n", name, switched ? "yes" : "no", sizes.size(),
               sizes[sizes.size() / 2], std::sqrt(sq), sizes.back(), beyond);
}

}  // namespace

int main(int argc, char** argv) {
    std::uint64_t fields = 100;
    int threads = 1;
    std::vector<std::string> sets;
    CLI::App app{"Outer fields against gyros at rest and in a steady turn", "zlg_field_campaign"};
    app.add_option("FIELDS", fields)->check(CLI::PositiveNumber);
    app.add_option("THREADS", threads)->check(CLI::PositiveNumber);
    app.add_option("--set", sets, "section.key=value, of all gyros; repeatable")->allow_extra_args(false);
    return trials::run_command(app, argc, argv, [&] {
        const std::vector<std::pair<std::string, std::vector<std::string>>> methods{
            {"none", {}},
            {"estimate", {"compensation.magnetic=\"estimate\""}},
            {"estimate, after_step", {"compensation.magnetic=\"estimate\"", "switching.after_step=\"switch\""}}};
        fmt::print(
            "| magnetic | a switch within the field | number | left, arcsec: median | rms | max | beyond 20 |\n"
            "|---|---|---|---|---|---|---|\n");
        for (const auto& [name, keys] : methods) {
            std::vector<std::string> all{"switching.interval_s=45", "switching.first_segment=\"half\""};
            all.insert(all.end(), keys.begin(), keys.end());
            all.insert(all.end(), sets.begin(), sets.end());
            config::Config config;
            for (const std::string& set : all) config::apply_set(config, set);
            std::vector<Left> left(fields);
            numeric::in_parallel(fields, threads,
                                 [&](std::size_t k) { left[k] = left_by(config, drawn(k + 1), k + 1); });
            print_row(name, left, true);
            print_row(name, left, false);
        }
        return 0;
    });
}
