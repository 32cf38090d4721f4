#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/firmware/exchange.hpp>
#include <zlg/firmware/stored.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/follower.hpp>
#include <zlg/rig/processor.hpp>
#include <zlg/text/whole_file.hpp>

#include "src/as_json.hpp"
#include "src/failure.hpp"
#include "src/gyro_line.hpp"
#include "src/options.hpp"
#include "src/output.hpp"
#include "src/verbs.hpp"

namespace zlg::cli {
namespace {

struct SettingsOptions : Options {
    std::string line;
    int baud = logs::default_baud;
};

// What both directions say of settings.
nlohmann::json facts(const firmware::Settings& settings) {
    return {{"version", fmt::format("{:016x}", firmware::layout())},
            {"bytes", firmware::stored_bytes},
            {"settings_crc", fmt::format("{:08x}", firmware::settings_crc(settings))},
            {"tick_s", settings.compensation.gyro.tick.value()}};
}

void say(const SettingsOptions& options, nlohmann::json facts, const std::string& done) {
    if (options.json) return print(pretty(facts));
    print(fmt::format(
        "{}\n{} bytes for the image of version {}, ticks of {} s; the gyro's status then says {} as CRC of its "
        "settings\n",
        done, facts["bytes"].get<std::size_t>(), facts["version"].get<std::string>(), facts["tick_s"].get<double>(),
        facts["settings_crc"].get<std::string>()));
}

void make(const SettingsOptions& options) {
    require_suffix(options.out, ".bin");
    refuse_own_input(options.config_path, options.out);
    const rig::ProcessorSettings made = rig::processor_settings(resolve(load_config(options)).config);
    alignas(firmware::Settings) std::array<std::uint8_t, firmware::stored_bytes> bytes{};
    firmware::put_stored({made.control, made.compensation}, bytes);
    write_file(options.out, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, options.force);
    nlohmann::json said = facts(firmware::settings_in(bytes));
    said["out"] = options.out;
    say(options, said, fmt::format("{}: what the gyro's processor stores", printable(options.out)));
}

// What is wrong with the file; empty where nothing is.
std::string objection(std::span<const std::uint8_t> bytes) {
    const std::string by_fault[]{
        "", "holds no settings; allowed is what `zlg settings --out` has written",
        fmt::format("{} bytes, whose checksum is wrong: it is cut or has changed; make it anew", bytes.size()),
        fmt::format("is for the image of version {:016x}; allowed is {:016x}: make it anew with this program",
                    firmware::layout_in(bytes), firmware::layout()),
        "the core refuses these settings; make them anew"};
    return by_fault[static_cast<std::size_t>(firmware::fault_of(bytes))];
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
