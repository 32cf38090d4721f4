#pragma once
// Which IMUs speak in a bag, and how their clocks go.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bag.hpp"
#include "imu_message.hpp"

namespace zlg::logs::bags {

// Messages of one topic and one frame.
struct ImuSensor {
    [[nodiscard]] bool is(const BagChannel& channel, const ImuMessage& message) const {
        return topic == channel.topic && frame_id == message.frame_id;
    }

    std::string topic;
    std::string frame_id;
    std::vector<std::uint32_t> channels;  // in the order of their first messages
    bool by_turns = false;                // of two publishers
    std::uint64_t n_messages = 0;
    std::int64_t first_stamp_ns = 0, last_stamp_ns = 0;
    std::int64_t first_received_ns = 0, last_received_ns = 0;
    std::array<bool, 3> has_rate{};      // about x, y, z, in some message
    double largest_delay_step_ns = 0.0;  // of how much later a message is received than it is stamped
};

struct ImuSurvey {
    std::vector<ImuSensor> sensors;
    std::string others;  // "/tf (tf2_msgs/TFMessage, 100 messages), ..."
    std::string end;     // what is said of an end that is missing

    // The one that is asked for, or the only one.
    //
    // errors  MappingError: there is no such, or it is open which; FormatError: there is none at all.
    [[nodiscard]] const ImuSensor& chosen(const std::string& path, const std::string& topic) const;
};

using ReadBag = std::string (*)(const std::string& path, const TakeMessage& take);

// errors  as read_mcap(); FormatError: more messages than a file of its size may hold, a message that is none.
[[nodiscard]] ImuSurvey surveyed(const std::string& path, ReadBag read);

// errors  MappingError: stamps that stand still, or go at another rate than the messages come.
void check_clocks(const std::string& path, const ImuSensor& sensor);

}  // namespace zlg::logs::bags
