#include <array>
#include <bit>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/logs/table_file.hpp>
#include <zlg/logs/unfinished.hpp>
#include <zlg/recorded/log_compensation.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/study/half_wave_replay.hpp>
#include <zlg/study/switch_table.hpp>
#include <zlg/text/spelling.hpp>

#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/interrupt.hpp"
#include "src/mapping_input.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/switch_csv.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

struct ProcessOptions : Options {
    std::string raw;
    std::string switches;  // file for the table of switches; empty: none
};

// The table of switches in a file of its own.
class Switches {
public:
    // errors  logs::IoError.
    Switches(const ProcessOptions& options, const config::Config& config)
        : table_{config.compensation.relock_ticks}, half_wave_{config} {
        if (!options.switches.empty()) file_.emplace(options.switches, options.force);
    }

    void take(const core::HalfRecord& half) {
        if (!file_) return;
        half_wave_.take(half);
        if (n_halves_ % 2 != 0) table_.take(n_halves_ / 2, first_, half);
        first_ = half;
        ++n_halves_;
    }
    void take(const core::AngleRow& row) { table_.take(row); }
    void take(const core::GapReport& gap) { table_.take(gap); }

    // The file gets its name.
    //
    // errors  logs::IoError.
    void close() {
        if (!file_) return;
        std::vector<study::SwitchLine> lines = table_.lines();
        half_wave_.fill(lines);
        file_->append(switch_csv(lines, false));
        file_->close();
    }

private:
    study::SwitchTable table_;
    study::HalfWaveReplay half_wave_;
    core::HalfRecord first_;  // of the tick
    std::int64_t n_halves_ = 0;
    std::optional<logs::TableFile> file_;
};

struct Summary {
    std::int64_t ticks = 0;
    std::int64_t gaps = 0;
    double angle_arcsec = 0.0;
    std::array<std::int64_t, core::angle_flag_names.size()> flagged{};
    bool in_gap = false;

    void take(const core::AngleRow& row) {
        ++ticks;
        const bool is_gap = (row.flags & (core::flag_loop_unlocked | core::flag_invalid)) != 0;
        gaps += is_gap && !in_gap ? 1 : 0;
        in_gap = is_gap;
        for (std::uint32_t rest = row.flags; rest != 0; rest &= rest - 1)  // most rows have none
            if (const auto bit = static_cast<std::size_t>(std::countr_zero(rest)); bit < flagged.size()) ++flagged[bit];
    }
};

// Every so many halves a signal is looked for and the progress shown.
constexpr std::int64_t stride_halves = 100'000;

Summary compensate(logs::RawReader& raw, rig::Replay& replay, logs::AngleWriter& angles, Switches& switches) {
    Summary summary;
    core::HalfRecord record;
    Progress progress;
    const bool has_light = raw.header().light_samples > 0;
    const auto write = [&](const core::AngleRow& row) {
        summary.take(row);
        switches.take(row);
        angles.write(row);
    };
    const auto note = [&](const core::GapReport& gap) { switches.take(gap); };
    while (raw.next(record)) {
        switches.take(record);
        replay.take(record, has_light ? raw.light() : core::LightSamples{}, write, note);
        if (replay.halves() % stride_halves != 0) continue;
        check_interrupt();
        progress.show(raw.fraction_read());
    }
    replay.end(write, note);
    summary.angle_arcsec = replay.angle_arcsec();
    return summary;
}

std::string text_of(const Summary& s, const ProcessOptions& options) {
    std::string flags;
    for (std::size_t bit = 0; bit < s.flagged.size(); ++bit)
        if (s.flagged[bit] > 0) flags += fmt::format("  {:<18} {}\n", core::angle_flag_names[bit], s.flagged[bit]);
    return fmt::format("{}: {} ticks, {} gaps, accumulated angle {} arcsec\n{}", printable(options.out), s.ticks,
                       s.gaps, s.angle_arcsec, flags.empty() ? "" : "ticks by flag:\n" + flags);
}

nlohmann::json process_json(const Summary& s, const ProcessOptions& options, const config::Config& config) {
    nlohmann::json flags = nlohmann::json::object();
    for (std::size_t bit = 0; bit < s.flagged.size(); ++bit) flags[core::angle_flag_names[bit]] = s.flagged[bit];
    return {{"raw", options.raw},
            {"angles", options.out},
            {"switches", options.switches.empty() ? nlohmann::json(nullptr) : nlohmann::json(options.switches)},
            {"ticks", s.ticks},
            {"gaps", s.gaps},
            {"angle_arcsec", s.angle_arcsec},
            {"flagged_ticks", flags},
            {"config", config_json(config)}};
}

void process(const ProcessOptions& options) {
    if (!text::lower_case(options.out).ends_with(".mcap")) (void)log_format(options.out);
    refuse_own_input(options.raw, options.out);
    if (!options.switches.empty()) {
        require_suffix(options.switches, ".csv");
        refuse_own_input(options.raw, options.switches, "--switches");
        refuse_same_output(options.switches, options.out, "--switches");
    }
    std::size_t n_warnings = 0;
    logs::RawReader raw = open_raw(options, options.raw, &n_warnings);
    const recorded::LogCompensation asked = log_compensation(options, raw.header(), options.raw);
    for (const std::string& warning : raw.header().warnings) complain("warning: " + warning);

    rig::Replay replay{asked.compensation};
    Switches switches{options, asked.config};
    logs::AngleWriter angles{options.out, asked.config.gyro.tick_s, rig::angle_settings(asked.config), options.force};
    const Summary summary = compensate(raw, replay, angles, switches);
    recorded::require_a_tick(replay, options.raw);
    if (const std::string odd = replay.odd_half(options.raw); !odd.empty()) complain("warning: " + odd);
    if (asked.lacks_detuning) warn_uncorrected(replay, options.raw);
    for (const std::string& wrong : replay.contradictions(options.raw)) complain("warning: " + wrong);
    if (!raw.header().complete)
        complain(fmt::format("warning: {}: was not closed by its writer; its whole rows are taken", options.raw));
    if (!raw.line_is_ended())
        complain(fmt::format("warning: {}: the last line has no end; the file may have been cut off", options.raw));
    const logs::Together all_or_none;
    switches.close();
    angles.close();
    print(options.json ? pretty(process_json(summary, options, asked.config)) : text_of(summary, options));
    refuse_warnings(options, n_warnings);
}

}  // namespace

void add_process(CLI::App& program) {
    const auto options = std::make_shared<ProcessOptions>();
    CLI::App* verb = program.add_subcommand("process", "a recorded raw log through the compensation");
    verb->add_option("RAW", options->raw,
                     "raw log, or a file of another program with counts (zlg import says what it is)")
        ->required();
    verb->add_option("--switches", options->switches, "one row per switch, CSV");
    add_mapping_options(*verb, *options);
    add_strict_option(*verb, *options);
    add_config_options(*verb, *options);
    add_output_options(*verb, *options);
    verb->get_option("--out")->description("where to write; .mcap: messages sensor_msgs/msg/Imu");
    verb->callback([options] { process(*options); });
}

}  // namespace zlg::cli
