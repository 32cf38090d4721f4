#pragma once
// The settings of an HDF5 log: /config and the attributes of the root.

#include <optional>

#include "csv_head.hpp"
#include "hdf5_source.hpp"
#include "hdf5_table_writer.hpp"

namespace zlg::logs::hdf5 {

inline constexpr std::int64_t format_version = 1;

// Writes /config and format_version, and of the settings tick_s and scale_arcsec, with or without `gyro.`, the attributes
// of that name; a given tick_s goes before theirs.
//
// errors  FormatError: a setting that is no text of one line; IoError.
void add_settings(TableWriter& table, const Settings& settings, std::optional<double> tick_s = std::nullopt);

// Reads /config; attributes of the root stand for settings that /config lacks.
//
// errors  FormatError: no TOML, another format_version, an attribute that is no number or contradicts /config.
[[nodiscard]] Settings read_settings(const Source& source);

}  // namespace zlg::logs::hdf5
