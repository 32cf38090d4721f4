#pragma once
// Records at rest and in motion as files, with a plan beside them.

#include <unistd.h>

#include <string>
#include <vector>

#include <fmt/format.h>

#include <zlg/acceptance/accept.hpp>
#include <zlg/chance/draw.hpp>

#include "test.hpp"

namespace zlg::acceptance_test {

// Of this process: tests run side by side.
inline std::string folder() {
    const std::string name = testing::TempDir() + fmt::format("zlg_acceptance_test_{}/", ::getpid());
    std::filesystem::create_directories(name);
    return name;
}

// A rate a line; of columns with a blank between them.
inline void write(const std::string& name, const std::vector<std::vector<double>>& columns) {
    std::ofstream out{folder() + name};
    for (std::size_t k = 0; k < columns.front().size(); ++k) {
        std::string line;
        for (const std::vector<double>& column : columns) line += fmt::format("{} ", column[k]);
        out << line << '\n';
    }
}

inline std::vector<double> white(std::size_t n, double deviation, std::uint64_t seed = 1) {
    chance::Draw draw{seed, chance::Cause::test};
    std::vector<double> values(n);
    for (double& value : values) value = deviation * draw.normal();
    return values;
}

// A run of one column at 10 rows a second.
inline std::string run(const std::string& kind, const std::string& file, const std::string& more = "") {
    return fmt::format(
        "[[run]]\nkind = '{}'\nfiles = ['{}']\ntime = 'none'\ncolumn = 1\nholds = 'rate'\nunit = 'deg/h'\nrate_hz = "
        "10\n{}",
        kind, file, more);
}

inline acceptance::Acceptance accepted(const std::string& runs, const std::string& limits = "",
                                       const std::string& accept = "") {
    std::ofstream{folder() + "plan.toml"} << "[unit]\nserial = 'A1'\ntype = 'Z'\n"
                                          << runs << "[accept]\n"
                                          << accept << "[limits]\n"
                                          << limits;
    return acceptance::accept({.plan = folder() + "plan.toml", .said = {}});
}

inline const acceptance::Judged& of(const acceptance::Acceptance& test, std::string_view name) {
    const auto found = std::ranges::find_if(test.quantities, [&](const auto& q) { return q.value.name == name; });
    EXPECT_NE(found, test.quantities.end()) << name;
    return *found;
}

}  // namespace zlg::acceptance_test
