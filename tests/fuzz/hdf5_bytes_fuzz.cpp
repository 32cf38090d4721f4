// A good HDF5 log in which some bytes were changed: what the disk, the network or another program does to a file.

#include "bytes.hpp"
#include "hdf5_objects.hpp"
#include "recognised.hpp"
#include "spoilt.hpp"

namespace {

using namespace zlg;

constexpr int n_rows = 12;

std::vector<std::uint8_t> raw_file() {
    const std::string path = fuzz::scratch().path("good_raw.h5");
    logs::RawWriter writer{path,
                           {{"gyro.tick_s", "0.005"}, {"note", "of the laboratory"}},
                           true,
                           logs::all_raw_columns,
                           {.light_samples = 2, .light_b = true}};
    for (int k = 0; k < n_rows; ++k) {
        const std::vector<float> light{1.0f, 0.25f * static_cast<float>(k)};
        writer.write({.half = k,
                      .counts = 150 - k,
                      .detuning_lambda = 0.01 * k,
                      .detuning_sq_lambda2 = 1.1e-4 * k * k,
                      .piezo_v = 150.0,
                      .temperature_c = 20.0,
                      .bias_sign = k % 2 == 0 ? std::int8_t{1} : std::int8_t{-1}},
                     {.a = light, .b = light});
    }
    writer.close();
    return fuzz::content(path);
}

std::vector<std::uint8_t> angle_file() {
    const std::string path = fuzz::scratch().path("good_angles.h5");
    logs::AngleWriter writer{path, 0.005, {{"gyro.scale_arcsec", "3.263"}}, true, {.has_truth = true}};
    for (int k = 0; k < n_rows; ++k) {
        writer.write({.tick = k, .dtheta_arcsec = 3.0 * k, .dtheta_final_arcsec = 3.1 * k, .sigma_arcsec = 1.3}, 3.0);
    }
    writer.close();
    return fuzz::content(path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::vector<std::uint8_t> good_raw = raw_file();
    static const std::vector<std::uint8_t> good_angles = angle_file();
    fuzz::claim_nothing_is_open();
    fuzz::Bytes bytes{data, size};
    std::vector<std::uint8_t> file = bytes.flag() ? good_angles : good_raw;
    while (!bytes.empty()) fuzz::spoil(bytes, file);
    fuzz::claim_log(fuzz::scratch().write("spoilt.h5", file.data(), file.size()));
    fuzz::claim_nothing_is_open();
    return 0;
}
