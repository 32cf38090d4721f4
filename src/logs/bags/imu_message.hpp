#pragma once
// sensor_msgs/Imu, as ROS 1 and ROS 2 (CDR) put it into bytes.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace zlg::logs::bags {

struct ImuMessage {
    std::int64_t stamp_ns = 0;
    std::string_view frame_id;
    std::array<double, 3> rate_rad_s{};  // about x, y, z; NaN where the message says that it has none
};

// `encoding`: "cdr" or "ros1". errors  Damaged: of another length, or with a stamp that is none.
[[nodiscard]] ImuMessage imu_message(std::string_view data, std::string_view encoding);

// The definition of the message in ROS 2, with those that it is made of.
extern const std::string_view imu_definition;

// One that turns about z, as CDR: there is nothing of the other axes (NaN, with an infinite variance), nor of the
// orientation and the acceleration (covariance -1).
[[nodiscard]] std::string imu_cdr(std::int64_t stamp_ns, std::string_view frame_id, double rate_rad_s,
                                  double variance_rad2_s2);

}  // namespace zlg::logs::bags
