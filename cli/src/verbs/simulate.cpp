#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/logs/table_file.hpp>
#include <zlg/logs/unfinished.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/refusal.hpp>
#include <zlg/rig/switch_count.hpp>
#include <zlg/rig/wire_stream.hpp>
#include <zlg/rig/wiring.hpp>

#include "src/as_json.hpp"
#include "src/cost.hpp"
#include "src/failure.hpp"
#include "src/interrupt.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

struct SimulateOptions : Options {
    std::string wire;
};

// What the gyro sends meanwhile, if anybody wants it.
class LineRecording {
public:
    LineRecording(const SimulateOptions& options, const config::Config& config) {
        if (options.wire.empty()) return;
        stream_.emplace(config);
        file_.emplace(options.wire, options.force);
    }

    void take(const rig::ClosedLoop& loop, const rig::LoopHalf& half) {
        if (!stream_) return;
        stream_->take(loop, half, bytes_);
        write();
    }

    void close() {
        if (!stream_) return;
        stream_->end(bytes_);
        write();
        file_->close();
    }

private:
    void write() {
        file_->append({reinterpret_cast<const char*>(bytes_.data()), bytes_.size()});
        bytes_.clear();
    }

    std::optional<rig::WireStream> stream_;
    std::optional<logs::TableFile> file_;
    std::vector<std::uint8_t> bytes_;
};

void record(rig::ClosedLoop& loop, std::int64_t ticks, bool with_light, logs::RawWriter& raw, LineRecording& line,
            rig::SwitchCount& count) {
    Progress progress;
    const std::int64_t progress_stride = std::clamp<std::int64_t>(ticks / 200, 1, 100'000);
    for (std::int64_t half = 0; half < 2 * ticks; ++half) {
        check_interrupt();
        const rig::LoopHalf made = loop.advance();
        raw.write(made.record, with_light ? loop.light() : core::LightSamples{});
        line.take(loop, made);
        count.take(made);
        if (half % (2 * progress_stride) == 0)
            progress.show(static_cast<double>(half) / static_cast<double>(2 * ticks));
    }
}

void simulate(const SimulateOptions& options) {
    const logs::LogFormat format = log_format(options.out);
    if (!options.wire.empty()) refuse_same_output(options.wire, options.out, "--wire");
    const config::Config config = resolve(load_config(options)).config;
    rig::require_every_half(config, "a raw log", "allowed is gyro.fidelity = \"averaged\" or \"laser\"");
    const int light_samples = logged_light_samples(options, config, format);
    const twin::Motion motion = recorded::motion(config);
    const std::int64_t ticks = rig::run_ticks(config, motion);
    rig::ClosedLoop loop{config, motion};
    rig::SwitchCount count{config};
    require_room(ticks,
                 raw_bytes(format == logs::LogFormat::csv, light_samples) + (options.wire.empty() ? 0.0 : wire_bytes),
                 options.out);
    std::string part;
    try {
        logs::RawWriter raw{options.out,
                            config::to_settings(config),
                            options.force,
                            raw_columns(config),
                            {.light_samples = light_samples, .light_b = light_samples > 0, .keep_part = true}};
        part = raw.part_path();
        LineRecording line{options, config};
        record(loop, ticks, light_samples > 0, raw, line, count);
        const logs::Together both_or_neither;
        line.close();
        raw.close();
    } catch (...) {
        rethrow_with({part});
    }
    const double duration_s = static_cast<double>(ticks) * config.gyro.tick_s;
    if (options.json)
        print(pretty(nlohmann::json{{"raw", options.out},
                                    {"halves", 2 * ticks},
                                    {"duration_s", duration_s},
                                    {"switches_failed", count.tally().failed},
                                    {"switches_withheld", count.tally().withheld}}));
    else
        print(fmt::format("{}: {} half-periods, {} s\n", printable(options.out), 2 * ticks, duration_s));
    refuse_a_run_that_lacks_switches(count.tally());
}

}  // namespace

void add_simulate(CLI::App& program) {
    const auto options = std::make_shared<SimulateOptions>();
    CLI::App* verb = program.add_subcommand(
        "simulate", "the same as run, writing only what the gyro's processor would have recorded");
    add_config_argument(*verb, *options);
    add_run_options(*verb, *options);
    add_light_option(*verb, *options);
    verb->add_option("--wire", options->wire, "also write what the gyro would have sent over its line, for zlg follow");
    add_output_options(*verb, *options);
    verb->callback([options] { simulate(*options); });
}

}  // namespace zlg::cli
