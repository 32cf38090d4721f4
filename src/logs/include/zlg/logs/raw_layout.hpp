#pragma once
// What stands in a raw log: its columns, what is above its rows, and how it is written.

#include <string>
#include <vector>

#include <zlg/logs/settings.hpp>

namespace zlg::logs {

// Which of the optional columns there are.
struct RawColumns {
    bool has_valid = false;
    bool has_detuning = false;     // detuning_lambda
    bool has_detuning_sq = false;  // detuning_sq_lambda2
    bool has_piezo = false;
    bool has_temperature = false;
    bool has_edge_offset = false;  // edge_offset_ticks, whose timer makes so many ticks per second:
    double timer_hz = 0.0;         // 1..1e15 where there are shifts, else not used
    bool has_span = false;
};

inline constexpr RawColumns all_raw_columns{.has_valid = true,
                                            .has_detuning = true,
                                            .has_detuning_sq = true,
                                            .has_piezo = true,
                                            .has_temperature = true,
                                            .has_span = true};

// What stands above the rows.
struct RawHeader : RawColumns {
    Settings settings;                  // `# key = value` or /config, in their order
    std::vector<std::string> warnings;  // unknown columns that are ignored, one line each
    int light_samples = 0;              // N of /raw/light; 0: there is none
    bool has_light_b = false;           // /raw/light_b beside it
    bool complete = true;               // false: an HDF5 log that is being written, or whose writer was interrupted
};

struct RawWriterOptions {
    int light_samples = 0;  // of each half and beam, 0..64; HDF5 only
    bool light_b = false;   // of beam B too
    // HDF5: destroyed before `close`, PATH.part stays, not complete, with all rows so far; without a row it goes.
    bool keep_part = false;
};

}  // namespace zlg::logs
