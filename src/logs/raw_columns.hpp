#pragma once
// The columns of a raw log.

#include <array>
#include <zlg/logs/raw_layout.hpp>

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

struct OptionalColumn {
    std::size_t column;
    bool RawColumns::*is_there;
};

inline constexpr std::array<OptionalColumn, 7> optional_columns{{{valid, &RawColumns::has_valid},
                                                                 {detuning_lambda, &RawColumns::has_detuning},
                                                                 {detuning_sq_lambda2, &RawColumns::has_detuning_sq},
                                                                 {piezo_v, &RawColumns::has_piezo},
                                                                 {temperature_c, &RawColumns::has_temperature},
                                                                 {edge_offset_ticks, &RawColumns::has_edge_offset},
                                                                 {span, &RawColumns::has_span}}};

constexpr bool is_written(const RawColumns& written, std::size_t column) {
    for (const OptionalColumn& optional : optional_columns)
        if (optional.column == column) return written.*optional.is_there;
    return true;
}

// Which of them a table has.
template <class Table>
void note_columns(const Table& table, RawColumns& columns) {
    for (const OptionalColumn& optional : optional_columns) columns.*optional.is_there = table.has(optional.column);
}

}  // namespace zlg::logs::raw
