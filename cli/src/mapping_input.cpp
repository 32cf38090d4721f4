#include "mapping_input.hpp"

#include <filesystem>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>

#include "failure.hpp"
#include "output.hpp"

namespace zlg::cli {

void add_mapping_options(CLI::App& verb, Options& options) {
    verb.add_option("--mapping", options.mapping_path,
                    "what a file of another program means, TOML (zlg import writes one)");
    verb.add_option("--map", options.maps, "key=value, over that file; repeatable")->allow_extra_args(false);
}

void add_strict_option(CLI::App& verb, Options& options) {
    verb.add_flag("--strict", options.strict, "exit status 1 where values may be no measurements");
}

void refuse_warnings(const Options& options, std::size_t n_warnings) {
    if (!options.strict || n_warnings == 0) return;
    explain_exit(fmt::format("--strict: {} line{} above say{} what may be no measurement", n_warnings,
                             n_warnings == 1 ? "" : "s", n_warnings == 1 ? "s" : ""));
    throw CLI::RuntimeError{result_says_no};
}

bool is_mapped(const Options& options) { return !options.mapping_path.empty() || !options.maps.empty(); }

logs::Mapping mapping_of(const Options& options) {
    logs::Mapping mapping;
    if (!options.mapping_path.empty()) logs::apply_mapping_file(mapping, options.mapping_path);
    for (const std::string& pair : options.maps) logs::apply_mapping_pair(mapping, pair);
    return mapping;
}

namespace {

// errors  UsageError: the head of a raw log of ours says otherwise.
void check_against_head(const std::string& path, const logs::Mapping& mapping) {
    logs::Settings head;
    try {
        head = logs::RawReader{path}.header().settings;
    } catch (const logs::FormatError&) {
        // It lacks a column of ours, which the mapping may say.
    }
    for (const auto& [key, value] : head)
        for (const char* mapped : {"tick_s", "scale_arcsec"})
            if (mapping.has(mapped) && key == fmt::format("gyro.{}", mapped) &&
                mapping.real(mapped) != std::strtod(value.c_str(), nullptr))
                throw UsageError{fmt::format("--map {} = {}: the head of {} says {}; allowed is to leave it out",
                                             mapped, mapping.text(mapped), path, value)};
}

}  // namespace

logs::ForeignLook look_at(const Options& options, const std::vector<std::string>& paths) {
    const logs::Mapping mapping = mapping_of(options);
    for (const std::string& path : paths) {
        const logs::LogKind kind = logs::recognise(path);
        // With a mapping that names its columns even a log may be read anew.
        if (is_angles(kind) || (is_raw(kind) && !is_mapped(options)))
            throw UsageError{fmt::format("{}: is {} log of zlg already, and needs no import", path,
                                         is_raw(kind) ? "a raw" : "an angle")};
        if (is_raw(kind)) check_against_head(path, mapping);
    }
    return logs::look_at_foreign(paths, mapping);
}

void note_all(const std::string& path, const std::vector<std::string>& notes) {
    for (const std::string& note : notes) complain(fmt::format("note: {}: {}", name_of_file(path), note));
}

logs::RawReader open_raw(const Options& options, const std::string& path, std::size_t* n_warnings) {
    // A pipe can be read once: it is a log of zlg.
    const bool can_be_looked_at = std::filesystem::is_regular_file(path);
    if (!is_mapped(options) && (!can_be_looked_at || logs::recognise(path) != logs::LogKind::unknown))
        return logs::RawReader{path};
    const logs::ForeignLook look = look_at(options, {path});
    if (look.makes != logs::Makes::raw)
        throw UsageError{
            fmt::format("{}: --map counts=COLUMN is missing: a raw log has counts; without them it is "
                        "read by analyze, and zlg import shows its columns",
                        path)};
    logs::ImportedRaw made = logs::imported_raw(look);
    note_all(path, look.table.notes);
    note_all(path, look.said);
    note_all(path, made.notes);
    note_all(path, made.warnings);
    if (n_warnings != nullptr) *n_warnings = made.warnings.size();
    return {path, std::move(made.header), std::move(made.rows)};
}

}  // namespace zlg::cli
