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
#include "interrupt.hpp"
#include "options.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace zlg::cli {
namespace {

void record(rig::ClosedLoop& loop, std::int64_t ticks, bool with_light, logs::RawWriter& raw,
            const Interruptible& interruptible) {
    Progress progress;
    const std::int64_t progress_stride = std::max<std::int64_t>(1, ticks / 200);
    for (std::int64_t half = 0; half < 2 * ticks; ++half) {
        interruptible.check();
        const core::HalfRecord record = loop.advance().record;
        raw.write(record, with_light ? loop.light() : core::LightSamples{});
        if (half % (2 * progress_stride) == 0)
            progress.show(static_cast<double>(half) / static_cast<double>(2 * ticks));
    }
}

void simulate(const Options& options) {
    const logs::LogFormat format = log_format(options.out);
    const config::Config config = with_laser_curve(with_interval(load_config(options)));
    const int light_samples = logged_light_samples(options, config, format);
    const twin::Motion motion = rig::motion(config);
    const std::int64_t ticks = rig::run_ticks(config, motion);
    rig::ClosedLoop loop{config, motion};
    const Interruptible interruptible;
    std::string part;
    try {
        logs::RawWriter raw{options.out,
                            config::to_settings(config),
                            options.force,
                            raw_columns(config),
                            {.light_samples = light_samples, .light_b = light_samples > 0, .keep_part = true}};
        part = raw.part_path();
        record(loop, ticks, light_samples > 0, raw, interruptible);
        raw.close();
    } catch (...) {
        rethrow_with({part});
    }
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
    add_light_option(*verb, *options);
    add_output_options(*verb, *options);
    verb->callback([options] { simulate(*options); });
}

}  // namespace zlg::cli
