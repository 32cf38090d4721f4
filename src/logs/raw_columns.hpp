#pragma once
// The columns of a raw log.

#include <array>
#include <zlg/logs/raw_log.hpp>

#include "column_map.hpp"

namespace zlg::logs::raw {

enum : std::size_t {
    half,
    bias_sign,
    mode,
    counts,
    loop_closed,
    valid,
    detuning_lambda,
    detuning_sq_lambda2,
    piezo_v,
    temperature_c,
    edge_offset_ticks,
    span,
    light,
    light_b,
};

inline constexpr std::array<Column, 12> csv_columns{{{"half", true},
                                                     {"bias_sign", true},
                                                     {"mode", true},
                                                     {"counts", true, "count"},
                                                     {"loop_closed", true},
                                                     {"valid", false},
                                                     {"detuning_lambda", false, "wavelength"},
                                                     {"detuning_sq_lambda2", false, "wavelength^2"},
                                                     {"piezo_v", false, "V"},
                                                     {"temperature_c", false, "degC"},
                                                     {"edge_offset_ticks", false},
                                                     {"span", false}}};

// In HDF5 also the light samples of both beams, halves x N.
inline constexpr std::array<Column, 14> hdf5_columns = [] {
    std::array<Column, 14> all{};
    for (std::size_t k = 0; k < csv_columns.size(); ++k) all[k] = csv_columns[k];
    all[light] = {"light", false, "1"};
    all[light_b] = {"light_b", false, "1"};
    return all;
}();

constexpr bool is_written(const RawColumns& written, std::size_t column) {
    switch (column) {
        case valid:
            return written.has_valid;
        case detuning_lambda:
            return written.has_detuning;
        case detuning_sq_lambda2:
            return written.has_detuning_sq;
        case piezo_v:
            return written.has_piezo;
        case temperature_c:
            return written.has_temperature;
        case edge_offset_ticks:
            return written.has_edge_offset;
        case span:
            return written.has_span;
        default:
            return true;
    }
}

}  // namespace zlg::logs::raw
