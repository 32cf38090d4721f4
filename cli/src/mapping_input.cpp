#include "mapping_input.hpp"

#include <fmt/format.h>

#include <zlg/logs/log_kind.hpp>

#include "failure.hpp"
#include "output.hpp"

namespace zlg::cli {

void add_mapping_options(CLI::App& verb, Options& options) {
    verb.add_option("--mapping", options.mapping_path,
                    "what a file of another program means, TOML (zlg import writes one)");
    verb.add_option("--map", options.maps, "key=value, over that file; repeatable")->allow_extra_args(false);
}

bool is_mapped(const Options& options) { return !options.mapping_path.empty() || !options.maps.empty(); }

logs::Mapping mapping_of(const Options& options) {
    logs::Mapping mapping;
    if (!options.mapping_path.empty()) logs::apply_mapping_file(mapping, options.mapping_path);
    for (const std::string& pair : options.maps) logs::apply_mapping_pair(mapping, pair);
    return mapping;
}

logs::ForeignLook look_at(const Options& options, const std::string& path) {
    const logs::Mapping mapping = mapping_of(options);
    const logs::LogKind kind = logs::recognise(path);
    // With a mapping that names its columns even a log may be read anew.
    if (is_angles(kind) || (is_raw(kind) && !is_mapped(options)))
        throw UsageError{fmt::format("{}: is {} log of zlg already, and needs no import", path,
                                     is_raw(kind) ? "a raw" : "an angle")};
    return logs::look_at_foreign(path, mapping);
}

logs::RawReader open_raw(const Options& options, const std::string& path) {
    if (!is_mapped(options)) return logs::RawReader{path};
    const logs::ForeignLook look = look_at(options, path);
    if (look.makes != logs::Makes::raw)
        throw UsageError{fmt::format("{}: --map counts=COLUMN is missing: a raw log has counts", path)};
    logs::ImportedRaw made = logs::imported_raw(look);
    for (const std::string& note : look.table.notes) complain(fmt::format("note: {}: {}", name_of_file(path), note));
    for (const std::string& note : look.said) complain(fmt::format("note: {}: {}", name_of_file(path), note));
    for (const std::string& note : made.notes) complain(fmt::format("note: {}: {}", name_of_file(path), note));
    return {path, std::move(made.header), std::move(made.rows)};
}

}  // namespace zlg::cli
