#include <chrono>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/logs/follower.hpp>
#include <zlg/study/fields.hpp>

#include "src/angle_recording.hpp"
#include "src/as_json.hpp"
#include "src/interrupt.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

struct FollowOptions : Options {
    std::string source;
    int baud = logs::default_baud;
    std::optional<double> at_most_s;
};

// Until the source ends, a signal comes, or the log or the time is as long as was asked for.
void receive(logs::Follower& follower, AngleRecording& recording, const std::optional<double>& duration_s) {
    using Clock = std::chrono::steady_clock;
    constexpr std::int64_t stride_rows = 1024;  // between two looks at the clock
    const auto started = Clock::now();
    const logs::Settings settings = logs::line_settings();
    core::AngleRow row;
    while (true) {
        if (is_interrupted()) follower.stop();
        const logs::Follower::Next next = follower.next(row);
        if (next == logs::Follower::Next::end) return;
        if (next == logs::Follower::Next::row) recording.write(row, *follower.rows().tick_s(), settings);
        if (next == logs::Follower::Next::row && follower.n_rows() % stride_rows != 0) continue;
        const auto now = Clock::now();
        if (duration_s && std::chrono::duration<double>{now - started}.count() >= *duration_s) follower.stop();
        recording.flush_now_and_then();
    }
}

std::string text(const logs::Follower& follower, const FollowOptions& options) {
    const logs::WireSummary& s = follower.rows().summary();
    const std::optional<double> tick_s = follower.rows().tick_s();
    std::string text = fmt::format("{}: {} ticks, accumulated angle {} arcsec\n", printable(options.out),
                                   follower.n_rows(), follower.angle_arcsec());
    text += fmt::format("{} bytes, {} messages\n", s.n_bytes, s.n_telemetry + s.n_status + s.n_replies);
    for (const study::LineCount& count : study::line_counts)
        if (s.*count.member > 0 && *count.words != '\0')
            text += fmt::format("{:>10} {}\n", s.*count.member, count.words);
    if (s.n_outages > 0)
        text += fmt::format(
            "{:>10} outages of more than {} ticks: {} ticks, in which it turned by {} arcsec, are in no row\n",
            s.n_outages, logs::max_lost_rows, s.n_outage_ticks, s.outage_arcsec);
    if (s.n_other_tick > 0)
        text += fmt::format("{:>10} messages of ticks of {} s; those of the log have {} s, so they are not in it\n",
                            s.n_other_tick, s.other_tick_s, *tick_s);
    return text;
}

nlohmann::json follow_json(const logs::Follower& follower, const FollowOptions& options) {
    const logs::WireSummary& s = follower.rows().summary();
    nlohmann::json j{{"source", options.source},
                     {"angles", options.out},
                     {"ticks", follower.n_rows()},
                     {"angle_arcsec", follower.angle_arcsec()},
                     {"outage_arcsec", s.outage_arcsec}};
    for (const study::LineCount& count : study::line_counts) j[count.name] = s.*count.member;
    return j;
}

void follow(const FollowOptions& options) {
    AngleRecording recording{options.source, options.out, options.force};
    refuse_own_input(options.source, options.out);
    logs::Follower follower{options.source, options.baud, options.at_most_s};
    will_finish();
    try {
        receive(follower, recording, options.at_most_s);
        recording.close();
    } catch (...) {
        rethrow_with({recording.part_path()});
    }
    print(options.json ? pretty(follow_json(follower, options)) : text(follower, options));
}

}  // namespace

void add_follow(CLI::App& program) {
    const auto options = std::make_shared<FollowOptions>();
    CLI::App* verb = program.add_subcommand("follow", "what a gyro sends over its line, as an angle log");
    verb->add_option("SOURCE", options->source,
                     "a file, a serial device, - for standard input, tcp:HOST:PORT or unix:PATH")
        ->required();
    verb->add_option("--baud", options->baud, "speed of a serial device (921600)");
    verb->add_option("--duration", options->at_most_s,
                     "end after so long, of the log or of the clock, whichever comes first");
    add_output_options(*verb, *options);
    verb->get_option("--out")->description("angle log to write: .csv, .h5 or .hdf5");
    verb->callback([options] { follow(*options); });
}

}  // namespace zlg::cli
