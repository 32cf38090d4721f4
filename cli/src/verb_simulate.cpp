#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/design_study.hpp>

#include "as_json.hpp"
#include "failure.hpp"
#include "options.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace zlg::cli {
namespace {

void simulate(const Options& options) {
    check_table_path(options.out);
    const config::Config config = with_interval(load_config(options));
    const twin::Motion motion = rig::motion(config);
    const std::int64_t ticks = rig::run_ticks(config, motion);
    rig::ClosedLoop loop{config, motion};
    logs::RawWriter raw{options.out, config::to_settings(config), options.force};
    Progress progress;
    const std::int64_t progress_stride = std::max<std::int64_t>(1, ticks / 200);
    for (std::int64_t tick = 0; tick < ticks; ++tick) {
        raw.write(loop.advance().record);
        raw.write(loop.advance().record);
        if (tick % progress_stride == 0) progress.show(static_cast<double>(tick) / static_cast<double>(ticks));
    }
    raw.close();
    const double duration_s = static_cast<double>(ticks) * config.gyro.tick_s;
    if (options.json)
        print(pretty(nlohmann::json{{"raw", options.out}, {"halves", 2 * ticks}, {"duration_s", duration_s}}));
    else
        print(fmt::format("{}: {} half-periods, {} s\n", options.out, 2 * ticks, duration_s));
}

}  // namespace

void add_simulate(CLI::App& program) {
    const auto options = std::make_shared<Options>();
    CLI::App* verb = program.add_subcommand(
        "simulate", "the same as run, writing only what the gyro's processor would have recorded");
    add_config_argument(*verb, *options);
    add_run_options(*verb, *options);
    add_output_options(*verb, *options);
    verb->callback([options] { simulate(*options); });
}

}  // namespace zlg::cli
