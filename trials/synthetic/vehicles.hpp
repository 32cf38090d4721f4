#pragma once
// Simulated recordings of vehicles, so that nothing is tuned on the one real recording: they stop, drive, turn and hit
// bumps.

#include <cstdint>
#include <string>
#include <vector>

namespace zlg::trials {

struct VehicleRecord {
    std::string name;
    double rate_hz = 200.0;
    std::vector<std::vector<double>> increment_arcsec;  // by axis, then by row
};

[[nodiscard]] std::vector<VehicleRecord> vehicle_records(bool quick, std::uint64_t seed);

}  // namespace zlg::trials
