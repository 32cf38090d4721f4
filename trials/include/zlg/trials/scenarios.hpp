#pragma once
// Gyros of every kind, with every method and fault, drawn from a seed: what two processors are held against each other
// with.

#include <cstdint>
#include <string>

#include <zlg/config/config.hpp>

namespace zlg::trials {

struct Scenario {
    std::string name;  // what was drawn, for a reader
    config::Config config;
};

// Scenario `k` of the endless sequence of a seed. Every choice of a method, of a loop, of a schedule and every kind of
// fault comes up again and again; `config` passes config::check and runs for `duration_s`.
//
// duration_s  20 or more.
[[nodiscard]] Scenario scenario(std::uint64_t seed, std::int64_t k, double duration_s);

}  // namespace zlg::trials
