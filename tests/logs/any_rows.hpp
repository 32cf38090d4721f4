#pragma once
// Numbers and rows of logs at random, the same in every run.

#include <rapidcheck.h>
#include <stdlib.h>

#include <zlg/core/records.hpp>

#include "test.hpp"

namespace zlg::test {

// Properties are tried on the same cases in every run.
inline const int fixed_seed = ::setenv("RC_PARAMS", "seed=1", 0);

inline rc::Gen<double> any_finite_double() {
    return rc::gen::map(rc::gen::arbitrary<std::uint64_t>(), [](std::uint64_t bits) {
        const auto value = std::bit_cast<double>(bits);
        return std::isfinite(value) ? value : 0.1;
    });
}

inline std::vector<core::HalfRecord> any_records(bool with_edges = false) {
    constexpr std::int64_t limit = std::int64_t{1} << 52;
    std::vector<core::HalfRecord> rows(*rc::gen::inRange<std::size_t>(1, 40));
    const bool first_positive = *rc::gen::arbitrary<bool>();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        core::HalfRecord& r = rows[i];
        r.half = static_cast<std::int64_t>(i);
        r.bias_sign = ((i % 2 == 0) == first_positive) ? 1 : -1;
        r.mode = *rc::gen::element<std::int8_t>(-1, 1);
        r.counts = *rc::gen::inRange<std::int64_t>(-limit, limit + 1);
        r.loop_closed = *rc::gen::arbitrary<bool>();
        r.valid = *rc::gen::arbitrary<bool>();
        r.detuning_lambda = std::fmod(*any_finite_double(), 30.0);
        r.detuning_sq_lambda2 = *rc::gen::arbitrary<bool>() ? r.detuning_lambda * r.detuning_lambda : 0.0;
        r.piezo_v = *any_finite_double();
        r.temperature_c = *any_finite_double();
        if (with_edges) r.edge_offset_ticks = *rc::gen::arbitrary<std::int32_t>();
    }
    return rows;
}

}  // namespace zlg::test
