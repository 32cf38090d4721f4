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

}  // namespace zlg::test
