#pragma once
// The settings of an HDF5 log: /config and the attributes of the root.

#include <zlg/logs/format_version.hpp>
#include <zlg/logs/settings.hpp>

#include "hdf5_source.hpp"
#include "hdf5_table_writer.hpp"

namespace zlg::logs::hdf5 {

// Writes /config and format_version, and of the settings tick_s and scale_arcsec, with or without `gyro.`, the
// attributes of that name.
//
// errors  FormatError: a setting that is no text of one line; IoError.
void add_settings(TableWriter& table, const Settings& settings, const FormatVersion& version);

// The same for an angle log: the settings `flags` and `tick_s` have attributes of their own and no line in /config.
//
// errors  FormatError: as above, or a setting `tick_s` that is no number; IoError.
void add_angle_settings(TableWriter& table, Settings settings, const FormatVersion& version);

// errors  FormatError: another one than there are.
[[nodiscard]] FormatVersion read_format_version(const Source& source);

// Reads /config; attributes of the root stand for settings that /config lacks.
//
// With `adds_tick` false, tick_s is only compared with /config.
//
// errors  FormatError: no TOML, an attribute that is no number or contradicts /config.
[[nodiscard]] Settings read_settings(const Source& source, bool adds_tick = true);

}  // namespace zlg::logs::hdf5
