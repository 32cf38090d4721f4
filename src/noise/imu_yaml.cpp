#include <zlg/noise/imu_yaml.hpp>

#include <cmath>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <zlg/logs/error.hpp>
#include <zlg/text/whole_file.hpp>

namespace zlg::noise {
namespace {

constexpr const char* first_key = "gyroscope_noise_density";

std::string read_whole(const std::string& path) {
    try {
        return text::read_whole(path);
    } catch (const text::CannotRead& error) {
        throw logs::IoError(fmt::format("cannot read {}: {}", path, error.what()));
    } catch (const text::TooLong& error) {
        throw logs::FormatError(error.what());
    }
}

// The map that has the gyro's keys.
YAML::Node keys_of(const YAML::Node& root, const std::string& path) {
    if (root.IsMap() && root[first_key]) return root;
    if (root.IsMap())
        for (const auto& item : root)
            if (item.second.IsMap() && item.second[first_key]) return item.second;
    throw logs::FormatError(fmt::format("{}: has no {}", path, first_key));
}

double number(const YAML::Node& keys, const char* key, bool may_be_zero, const std::string& path) {
    const YAML::Node node = keys[key];
    if (!node || !node.IsScalar()) throw logs::FormatError(fmt::format("{}: has no {}", path, key));
    double value = 0.0;
    const bool read = YAML::convert<double>::decode(node, value);
    if (!read || !std::isfinite(value) || !(may_be_zero ? value >= 0.0 : value > 0.0))
        throw logs::FormatError(fmt::format("{}: {} = {}, allowed is a number {}", path, key, node.Scalar(),
                                            may_be_zero ? "from 0" : "above 0"));
    return value;
}

}  // namespace

KalibrGyro read_imu_yaml(const std::string& path) {
    try {
        const YAML::Node keys = keys_of(YAML::Load(read_whole(path)), path);
        return {.noise_density_rad_s_sqrt_hz = number(keys, first_key, false, path),
                .random_walk_rad_s2_sqrt_hz = number(keys, "gyroscope_random_walk", true, path),
                .update_rate_hz = number(keys, "update_rate", false, path)};
    } catch (const YAML::Exception& error) {
        throw logs::FormatError(fmt::format("{}:{}: is no YAML: {}", path, error.mark.line + 1, error.msg));
    }
}

std::string imu_yaml(const KalibrGyro& gyro) {
    return fmt::format(
        "# accelerometer_noise_density:  # m/s^2/sqrt(Hz), not known here\n"
        "# accelerometer_random_walk:    # m/s^3/sqrt(Hz), not known here\n"
        "gyroscope_noise_density: {}  # rad/s/sqrt(Hz), continuous: angle random walk\n"
        "gyroscope_random_walk: {}  # rad/s^2/sqrt(Hz), continuous: rate random walk{}\n"
        "rostopic: /imu0\n"
        "update_rate: {}  # Hz\n",
        gyro.noise_density_rad_s_sqrt_hz, gyro.random_walk_rad_s2_sqrt_hz,
        gyro.random_walk_is_limit ? "; upper limit, none was found" : "", gyro.update_rate_hz);
}

}  // namespace zlg::noise
