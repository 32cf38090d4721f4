#pragma once
// All rows of a raw log.

#include <zlg/logs/raw_log.hpp>

#include "test.hpp"

namespace zlg::test {

inline std::vector<core::HalfRecord> rows_of(logs::RawReader& reader) {
    std::vector<core::HalfRecord> rows;
    for (core::HalfRecord row; reader.next(row);) rows.push_back(row);
    return rows;
}

inline std::vector<core::HalfRecord> rows_of(const std::string& path) {
    logs::RawReader reader{path};
    return rows_of(reader);
}

// Recognisable in every column.
inline core::HalfRecord row_of(std::int64_t half) {
    const auto x = static_cast<double>(half);
    return {.half = half,
            .counts = 151 - 302 * (half % 2) + half % 17,
            .detuning_lambda = 1e-3 * std::sin(x),
            .detuning_sq_lambda2 = 1e-6 * x,
            .piezo_v = 150.0 + x,
            .temperature_c = 20.0 - 1e-4 * x,
            .bias_sign = static_cast<std::int8_t>(half % 2 == 0 ? 1 : -1),
            .mode = static_cast<std::int8_t>(half % 1000 < 500 ? 1 : -1),
            .loop_closed = half % 500 > 3,
            .valid = half % 777 != 0};
}

}  // namespace zlg::test
