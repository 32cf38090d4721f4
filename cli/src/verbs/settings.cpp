#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/firmware/exchange.hpp>
#include <zlg/firmware/stored.hpp>
#include <zlg/logs/byte_source.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/follower.hpp>
#include <zlg/rig/processor.hpp>
#include <zlg/text/whole_file.hpp>
#include <zlg/wire/command.hpp>
#include <zlg/wire/parameters.hpp>

#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/interrupt.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds reply_patience{200};
constexpr int most_tries = 10;

// A number that no host before this one has used just now.
std::uint16_t any_session() {
    return static_cast<std::uint16_t>(std::chrono::system_clock::now().time_since_epoch().count() >> 16);
}

std::string why_not(const wire::Reply& reply) {
    using enum wire::CommandResult;
    switch (reply.result) {
        case done:
            return "";
        case damaged:
            return "they did not come whole";
        case other_program:
            return "they are for the image of another version than this gyro has";
        case switch_under_way:
            return "a switch is under way; try again when it has ended";
        case not_allowed:
            return fmt::format("its core refuses them, {} fault {}",
                               reply.part == wire::RefusingPart::control ? "control" : "compensation", reply.fault);
        case malformed:
        case unknown_key:
        case read_only:
        case not_a_value:
            break;
    }
    return "it does not know the command; its image is older";
}

class Line {
public:
    Line(const std::string& name, int baud) : name_{name}, bytes_{name, baud, logs::ByteSource::Access::both} {}

    // The reply to a piece, which is sent again until it comes.
    wire::Reply ask(const wire::SettingsPiece& piece) {
        const std::uint32_t sequence = sender_.sequence;
        const wire::Frame frame = frame_of(sender_, piece);
        for (int k = 0; k < most_tries; ++k) {
            bytes_.write(frame.view());
            if (const auto reply = listen(sequence)) return *reply;
        }
        throw logs::IoError{fmt::format("{}: no answer from a gyro", printable(name_))};
    }

private:
    std::optional<wire::Reply> listen(std::uint32_t sequence) {
        const auto end = Clock::now() + reply_patience;
        while (Clock::now() < end) {
            interruptible_.check();
            std::array<std::uint8_t, 512> room{};
            std::size_t n = 0;
            const auto read = bytes_.read(room, n, 20);
            if (read == logs::ByteSource::Read::end)
                throw logs::IoError{fmt::format("{}: the line has ended", printable(name_))};
            if (read != logs::ByteSource::Read::bytes) continue;
            std::span<const std::uint8_t> bytes = std::span{room}.first(n);
            for (wire::Message message; receive(receiver_, bytes, message);)
                if (const auto reply = reply_in(message);
                    reply && reply->session == sender_.session && reply->sequence == sequence)
                    return reply;
        }
        return std::nullopt;
    }

    std::string name_;
    logs::ByteSource bytes_;
    wire::Sender sender_{.session = any_session()};
    wire::Receiver receiver_;
    Interruptible interruptible_;
};

// Settings over the line into a gyro, as docs/wire.md has it: pieces, each answered, and the check of the whole.
//
// errors  logs::SourceError, logs::IoError: no such line, no answer, or what the gyro objects to: its old settings
//         stay.
void load_over_line(const std::string& line, int baud, std::span<const std::uint8_t> settings) {
    Line gyro{line, baud};
    for (std::size_t at = 0; true; at += wire::max_piece_bytes) {
        at = std::min(at, settings.size());
        const auto piece = settings.subspan(at, std::min(wire::max_piece_bytes, settings.size() - at));
        const wire::Reply reply = gyro.ask({.offset = static_cast<std::uint16_t>(at), .bytes = piece});
        if (const std::string why = why_not(reply); !why.empty())
            throw logs::IoError{
                fmt::format("{}: the gyro keeps its old settings and not these: {}", printable(line), why)};
        if (piece.empty()) return;
    }
}

struct SettingsOptions : Options {
    std::string line;
    int baud = logs::default_baud;
};

// What both directions say of settings.
nlohmann::json facts(const firmware::Settings& settings) {
    return {{"version", fmt::format("{:016x}", firmware::layout())},
            {"bytes", firmware::stored_bytes},
            {"parameters_crc", fmt::format("{:08x}", wire::settings_crc(settings))},
            {"tick_s", settings.compensation.gyro.tick.value()}};
}

void say(const SettingsOptions& options, nlohmann::json facts, const std::string& done) {
    if (options.json) return print(pretty(facts));
    print(fmt::format(
        "{}\n{} bytes for the image of version {}, ticks of {} s; the gyro's status then says {} as CRC of its "
        "parameters\n",
        done, facts["bytes"].get<std::size_t>(), facts["version"].get<std::string>(), facts["tick_s"].get<double>(),
        facts["parameters_crc"].get<std::string>()));
}

void make(const SettingsOptions& options) {
    require_suffix(options.out, ".bin");
    refuse_own_input(options.config_path, options.out);
    const rig::ProcessorSettings made = rig::processor_settings(resolve(load_config(options)).config);
    const firmware::Settings settings{made.control, made.compensation};
    alignas(firmware::Settings) std::array<std::uint8_t, firmware::stored_bytes> bytes{};
    firmware::put_stored(settings, bytes);
    write_file(options.out, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, options.force);
    nlohmann::json said = facts(settings);
    said["out"] = options.out;
    say(options, said, fmt::format("{}: what the gyro's processor stores", printable(options.out)));
}

// What is wrong with the file; empty where nothing is.
std::string objection(std::span<const std::uint8_t> bytes) {
    using enum firmware::StoredFault;
    switch (firmware::fault_of(bytes)) {
        case none:
            break;
        case other_kind:
            return "holds no settings; allowed is what `zlg settings --out` has written";
        case damaged:
            return fmt::format("{} bytes, whose checksum is wrong: it is cut or has changed; make it anew",
                               bytes.size());
        case other_program:
            return fmt::format(
                "is for the image of version {:016x}; allowed is {:016x}: make it anew with this program",
                firmware::layout_in(bytes), firmware::layout());
        case refused:
            return "the core refuses these settings; make them anew";
    }
    return {};
}

std::vector<std::uint8_t> read_settings(const std::string& path) {
    try {
        const std::string text = text::read_whole(path);
        return {text.begin(), text.end()};
    } catch (const text::CannotRead& error) {
        throw logs::IoError{fmt::format("cannot read {}: {}", printable(path), error.what())};
    }
}

void load(const SettingsOptions& options) {
    if (options.config_path.empty()) throw UsageError{"--to: name the file of settings that is to be loaded"};
    if (!options.sets.empty()) throw UsageError{"--set: is for making settings; these are loaded as they are"};
    const std::vector<std::uint8_t> bytes = read_settings(options.config_path);
    if (const std::string why = objection(bytes); !why.empty())
        throw logs::FormatError{fmt::format("{}: {}", printable(options.config_path), why)};
    load_over_line(options.line, options.baud, bytes);
    nlohmann::json said = facts(firmware::settings_in(bytes));
    said["to"] = options.line;
    say(options, said, fmt::format("{}: loaded and stored; the gyro begins anew with them", printable(options.line)));
}

void settings(const SettingsOptions& options) {
    if (options.out.empty() == options.line.empty())
        throw UsageError{"allowed is one of --out SETTINGS.bin, which makes them, and --to LINE, which loads them"};
    options.line.empty() ? make(options) : load(options);
}

}  // namespace

void add_settings(CLI::App& program) {
    const auto options = std::make_shared<SettingsOptions>();
    CLI::App* verb = program.add_subcommand(
        "settings",
        "a configuration as the settings that the gyro's processor stores, and over the line into the gyro");
    add_config_argument(*verb, *options);
    add_output_options(*verb, *options);
    verb->add_option("--to", options->line,
                     "load the file of settings that is given into the gyro at this line: a serial device, "
                     "tcp:HOST:PORT or unix:PATH")
        ->check(is_a_name());
    verb->add_option("--baud", options->baud, "speed of a serial device (921600)");
    verb->callback([options] { settings(*options); });
}

}  // namespace zlg::cli
