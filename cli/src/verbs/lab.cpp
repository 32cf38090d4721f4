#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/live/page_server.hpp>
#include <zlg/live/record_book.hpp>
#include <zlg/live/record_source.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/follower.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/rig/asked_compensation.hpp>

#include "lab_page.hpp"
#include "src/angle_recording.hpp"
#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/interrupt.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

struct LabFollowOptions : Options {
    std::string source;  // what zlg follow takes, or an HDF5 log that grows
    int baud = 0;        // of a serial device
    std::uint16_t port = 0;
};

using live::RecordSource;

std::unique_ptr<RecordSource> raw_source(const LabFollowOptions& options) {
    logs::RawReader raw{options.source};
    const recorded::LogCompensation asked = log_compensation(options, raw.header(), options.source);
    return live::log_source(std::move(raw), options.source, asked.compensation, asked.config.gyro.tick_s,
                            rig::angle_settings(asked.config));
}

std::unique_ptr<RecordSource> angle_source(const LabFollowOptions& options) {
    if (!options.out.empty())
        throw UsageError{fmt::format("--out: {} is an angle log already; `zlg convert` copies one", options.source)};
    auto source = live::log_source(logs::AngleReader{options.source});
    if (!source->tick_s())
        throw logs::FormatError{fmt::format(
            "{}: has no setting tick_s, so the times of its ticks are not known; allowed is a log that says it",
            options.source)};
    return source;
}

void refuse_settings(const LabFollowOptions& options, const char* kind) {
    if (options.sets.empty() && options.config_path.empty()) return;
    throw UsageError{
        fmt::format("--set and --config are for the compensation of a raw log; {} is {}, which has its angles already",
                    options.source, kind)};
}

// A log is known by its content; what is none, is a line, or was recorded from one.
std::unique_ptr<RecordSource> opened(const LabFollowOptions& options) {
    std::error_code no_such_file;  // then the source is a device or an address
    if (std::filesystem::is_regular_file(options.source, no_such_file)) {
        switch (logs::recognise(options.source)) {
            case logs::LogKind::raw_hdf5: return raw_source(options);
            case logs::LogKind::angle_hdf5: refuse_settings(options, "an angle log"); return angle_source(options);
            case logs::LogKind::raw_csv:
            case logs::LogKind::angle_csv:
                throw UsageError{fmt::format(
                    "--follow: {} is a CSV log; allowed is HDF5, which can be read while it grows", options.source)};
            case logs::LogKind::unknown: break;
        }
    }
    refuse_settings(options, "a gyro's line");
    return live::line_source(options.source, options.baud);
}

// Records go to the log first, then to the pages.
class Receiver {
public:
    Receiver(const LabFollowOptions& options, RecordSource& source, live::RecordBook& book)
        : source_{source}, book_{book}, settings_{source.settings()} {
        if (!options.out.empty()) recording_.emplace(options.source, options.out, options.force);
    }

    // Until the source ends or a signal comes; the log is then complete.
    void receive() {
        try {
            while (take())
                if (recording_) recording_->flush_now_and_then();
            if (recording_) recording_->close();
        } catch (...) {
            rethrow_with({recording_ ? recording_->part_path() : std::string{}});
        }
    }

    [[nodiscard]] std::int64_t n_rows() const { return n_rows_; }

private:
    bool take() {
        if (is_interrupted()) source_.stop();
        live::Record record;
        const RecordSource::Next next = source_.next(record);
        if (next == RecordSource::Next::end) return false;
        const std::optional<double> tick_s = source_.tick_s();
        if (next == RecordSource::Next::nothing || !tick_s) return true;
        if (recording_) recording_->write(record.angle, *tick_s, settings_);
        book_.add(record, *tick_s);
        ++n_rows_;
        return true;
    }

    RecordSource& source_;
    live::RecordBook& book_;
    logs::Settings settings_;
    std::optional<AngleRecording> recording_;
    std::int64_t n_rows_ = 0;
};

// Since `complain` waits for the end of the program, a page would be open before it is said where.
void announce(std::uint16_t port) {
    print(fmt::format("open http://127.0.0.1:{}/ in a browser of this machine; Ctrl-C ends\n", port));
}

// Serves until a signal comes, also when the source has ended; with `out` the angles are recorded meanwhile.
void follow_in_page(const LabFollowOptions& options) {
    if (!options.out.empty()) {
        (void)log_format(options.out);
        refuse_own_input(options.source, options.out);
    }
    std::string page = live_lab_page();
    const std::unique_ptr<RecordSource> source = opened(options);
    live::RecordBook book{options.source == "-" ? "standard input" : options.source, source->tells_health()};
    Receiver receiver{options, *source, book};
    will_finish();
    const live::PageServer server{std::move(page), book, options.port};
    announce(server.port());
    receiver.receive();
    if (receiver.n_rows() == 0 && !is_interrupted())
        throw logs::IoError{fmt::format("{}: has ended without a tick of a gyro in it", printable(options.source))};
    for (const std::string& warning : source->warnings()) complain("warning: " + warning);
    book.end();
    // What has come is still there to be looked at.
    while (!is_interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds{50});
    if (!options.out.empty()) print(fmt::format("{}: {} ticks\n", printable(options.out), receiver.n_rows()));
}

constexpr std::uint16_t default_port = 8137;

void write_page(const Options& options) {
    if (options.out.empty()) throw UsageError{"--out: name the file of the page, for example --out lab.html"};
    require_suffix(options.out, ".html");
    write_file(options.out, lab_page(), options.force);
    if (options.json)
        print(pretty(nlohmann::json{{"page", options.out}}));
    else
        print(fmt::format("open {} in a browser\n", printable(options.out)));
}

void lab(const LabFollowOptions& options) {
    if (options.source.empty()) return write_page(options);
    if (options.json) throw UsageError{"--json: --follow has no result; leave one of them out"};
    follow_in_page(options);
}

}  // namespace

void add_lab(CLI::App& program) {
    const auto options = std::make_shared<LabFollowOptions>();
    options->baud = logs::default_baud;
    options->port = default_port;
    CLI::App* verb =
        program.add_subcommand("lab", "the gyro in one page, which runs in a browser without network or server");
    CLI::Option* follow =
        verb->add_option("--follow", options->source,
                         "show what a gyro gives now: SOURCE of `zlg follow`, or an HDF5 log that is being written; "
                         "the page is then served to this machine alone, and --out names an angle log to record")
            ->type_name("FILE|DEVICE|ADDRESS")
            ->check(is_a_name());
    verb->add_option("--port", options->port, fmt::format("of 127.0.0.1, 0: any that is free ({})", default_port))
        ->needs(follow)
        ->check(CLI::Range(0, 65535).description(""));
    verb->add_option("--baud", options->baud, "speed of a serial device (921600)")->needs(follow);
    add_config_options(*verb, *options);
    for (const char* option : {"--config", "--set"}) verb->get_option(option)->needs(follow);
    add_output_options(*verb, *options);
    verb->callback([options] { lab(*options); });
}

}  // namespace zlg::cli
