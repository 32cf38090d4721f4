#pragma once
// sensor_msgs/Imu, as ROS 1 and ROS 2 (CDR) put it into bytes.

#include <array>
#include <cstdint>
#include <string_view>

namespace zlg::logs::bags {

struct ImuMessage {
    std::int64_t stamp_ns = 0;
    std::string_view frame_id;
    std::array<double, 3> rate_rad_s{};  // about x, y, z; NaN where the message says that it has none
};

// `encoding`: "cdr" or "ros1". errors  Damaged: of another length, or with a stamp that is none.
[[nodiscard]] ImuMessage imu_message(std::string_view data, std::string_view encoding);

}  // namespace zlg::logs::bags
