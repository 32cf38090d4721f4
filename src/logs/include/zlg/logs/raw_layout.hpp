#pragma once
// What stands in a raw log: its columns, what is above its rows, and how it is written.

#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/row_rules.hpp>
#include <zlg/logs/settings.hpp>
#include <zlg/logs/table_column.hpp>

namespace zlg::logs {

// Which of the optional columns there are.
struct RawColumns {
    bool has_valid = false;
    bool has_detuning = false;
    bool has_detuning_sq = false;
    bool has_piezo = false;
    bool has_temperature = false;
    bool has_edge_offset = false;  // of a timer that makes so many ticks per second:
    double timer_hz = 0.0;         // 1..1e15 where there are shifts, else not used
    bool has_span = false;
    bool has_fringe = false;
    bool has_late = false;
    bool has_lit = false;
};

inline constexpr RawColumns all_raw_columns{.has_valid = true,
                                            .has_detuning = true,
                                            .has_detuning_sq = true,
                                            .has_piezo = true,
                                            .has_temperature = true,
                                            .has_span = true,
                                            .has_lit = true};

struct RawHeader : RawColumns, LogHeader {
    int light_samples = 0;     // N of /raw/light; 0: there is none
    bool has_light_b = false;  // /raw/light_b beside it
};

struct RawWriterOptions {
    int light_samples = 0;  // of each half and beam, 0..64; HDF5 only
    bool light_b = false;   // of beam B too
    // HDF5: destroyed before `close`, PATH.part stays, not complete, with all rows so far; without a row it goes.
    bool keep_part = false;
    bool has_fingerprint = false;                         // room for one, which `set_fingerprint` fills
    FormatVersion format_version = logs::format_version;  // of a copy that of its source
};

// All columns of a raw log but the light, in the order of a CSV log.
struct RawTable {
    using Row = core::HalfRecord;
    using Header = RawHeader;
    using Presence = RawColumns;

    static constexpr const char* group = "/raw";  // of an HDF5 log
    static constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();
    // Counts up to here, and the sum of two of them, are exact in a double.
    static constexpr std::int64_t max_counts = std::int64_t{1} << 52;
    // Detunings beyond this are none of a perimeter that is held: the light's discriminator ends before one wavelength.
    static constexpr double max_lambda = 30.0;
    static constexpr Real detuning{-max_lambda, max_lambda, "wavelengths"};
    static constexpr Real detuning_sq{0.0, max_lambda* max_lambda, "wavelengths^2"};  // 0: not known

    static constexpr std::tuple columns{
        required_column<std::int64_t>("half", "1", &Row::half, RowNumber{}),
        required_column<std::int8_t>("bias_sign", "1", &Row::bias_sign, Sign{}),  // see also RawSequence
        required_column<std::int8_t>("mode", "1", &Row::mode, Sign{}),
        required_column<std::int64_t>("counts", "count", &Row::counts, Whole{-max_counts, max_counts}),
        required_column<std::uint8_t>("loop_closed", "1", &Row::loop_closed, Flag{}),
        optional_column<std::uint8_t>("valid", "1", &Row::valid, Flag{}, &Presence::has_valid, 1),
        optional_column("detuning_lambda", "wavelength", &Row::detuning_lambda, detuning, &Presence::has_detuning,
                        not_measured),
        optional_column("detuning_sq_lambda2", "wavelength^2", &Row::detuning_sq_lambda2, detuning_sq,
                        &Presence::has_detuning_sq, not_measured),
        optional_column("piezo_v", "V", &Row::piezo_v, Real{}, &Presence::has_piezo, not_measured),
        optional_column("temperature_c", "degC", &Row::temperature_c, Real{}, &Presence::has_temperature, not_measured),
        optional_column("edge_offset_ticks", "1", &Row::edge_offset_ticks, any_whole<std::int32_t>,
                        &Presence::has_edge_offset, std::int32_t{0}, true),
        optional_column("span", "1", &Row::span, any_whole<std::int32_t>, &Presence::has_span, std::int32_t{1}, true),
        optional_column<double>("fringe", "1/65536", &Row::fringe, Fringe{}, &Presence::has_fringe, not_measured),
        optional_column<std::uint8_t>("late", "1", &Row::late, Flag{}, &Presence::has_late, 0),
        optional_column<std::uint8_t>("lit", "1", &Row::lit, Flag{}, &Presence::has_lit, 0),
    };
};

}  // namespace zlg::logs
