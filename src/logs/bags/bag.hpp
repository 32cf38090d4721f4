#pragma once
// The messages of a bag in the order of the file. Indexes are neither needed nor used.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace zlg::logs::bags {

// What one publisher sends.
struct BagChannel {
    std::uint32_t number = 0;
    std::string topic;
    std::string type;      // "sensor_msgs/Imu", of ROS 1 and ROS 2
    std::string encoding;  // "cdr", "ros1", ...
    std::uint64_t n_messages = 0;

    // Whose messages can be read.
    [[nodiscard]] bool is_imu() const { return type == "sensor_msgs/Imu" && (encoding == "cdr" || encoding == "ros1"); }
};

struct BagMessage {
    const BagChannel& channel;
    std::int64_t received_ns;
    std::string_view data;  // empty of what is no IMU
};

using TakeMessage = std::function<void(const BagMessage&)>;

// MCAP, and ROS 1 bags of version 2.0. Returns what is said of an end that is missing; empty of a whole bag.
//
// What is packed may be 260 times as large as the file, and 64 MiB in any case: a message of an IMU has 324 bytes, of
// which five values are taken, and of values four a byte of a file are allowed, and 2^20.
//
// errors  IoError; FormatError: path, byte, what is wrong, what is allowed.
[[nodiscard]] std::string read_mcap(const std::string& path, const TakeMessage& take);
[[nodiscard]] std::string read_rosbag(const std::string& path, const TakeMessage& take);

}  // namespace zlg::logs::bags
