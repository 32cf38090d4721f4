#include "imu_survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <zlg/logs/budget.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/mapping.hpp>
#include <zlg/text/escape.hpp>

#include "byte_stream.hpp"
#include "foreign/stored_numbers.hpp"

namespace zlg::logs::bags {

namespace {

constexpr std::size_t max_sensors = 100;

std::string shown(const std::string& name) { return text::excerpt(name, 60, ' '); }

void count(std::vector<ImuSensor>& sensors, const BagMessage& message, const ImuMessage& imu) {
    auto found = std::ranges::find_if(sensors, [&](const ImuSensor& s) { return s.is(message.channel, imu); });
    if (found == sensors.end()) {
        if (sensors.size() >= max_sensors)
            throw Damaged(fmt::format("is of one sensor too many, by topics and frames; allowed are {}", max_sensors));
        sensors.push_back({.topic = message.channel.topic,
                           .frame_id = std::string{imu.frame_id},
                           .channels = {message.channel.number},
                           .first_stamp_ns = imu.stamp_ns,
                           .last_stamp_ns = imu.stamp_ns,
                           .first_received_ns = message.received_ns,
                           .last_received_ns = message.received_ns});
        found = std::prev(sensors.end());
    }
    ImuSensor& sensor = *found;
    if (sensor.channels.back() != message.channel.number) {
        sensor.by_turns |= std::ranges::find(sensor.channels, message.channel.number) != sensor.channels.end();
        if (!sensor.by_turns) sensor.channels.push_back(message.channel.number);
    }
    const double step = static_cast<double>(message.received_ns) - static_cast<double>(sensor.last_received_ns) -
                        (static_cast<double>(imu.stamp_ns) - static_cast<double>(sensor.last_stamp_ns));
    sensor.largest_delay_step_ns = std::max(sensor.largest_delay_step_ns, std::fabs(step));
    sensor.last_stamp_ns = imu.stamp_ns;
    sensor.last_received_ns = message.received_ns;
    for (std::size_t k = 0; k < imu.rate_rad_s.size(); ++k) sensor.has_rate[k] |= !std::isnan(imu.rate_rad_s[k]);
    ++sensor.n_messages;
}

double hz(const ImuSensor& sensor, double span_ns) {
    return 1e9 * static_cast<double>(sensor.n_messages - 1) / span_ns;
}

}  // namespace

ImuSurvey surveyed(const std::string& path, ReadBag read) {
    ImuSurvey survey;
    Budget budget{path, Piece::of_file(path).size()};
    std::map<std::pair<std::string, std::string>, std::uint64_t> others;
    survey.end = read(path, [&](const BagMessage& message) {
        if (message.channel.is_imu()) {
            budget.take_values(1, 5);
            count(survey.sensors, message, imu_message(message.data, message.channel.encoding));
        } else if (message.channel.n_messages == 1 || others.size() < max_sensors) {
            ++others[{message.channel.topic, message.channel.type}];
        }
    });
    for (const auto& [name, n] : others)
        if (survey.others.size() < 300)
            survey.others += fmt::format("{}'{}' ({}, {} messages)", survey.others.empty() ? "" : ", ",
                                         shown(name.first), shown(name.second), n);
    return survey;
}

const ImuSensor& ImuSurvey::chosen(const std::string& path, const std::string& topic) const {
    if (sensors.empty())
        throw FormatError(fmt::format("{}: holds no message of sensor_msgs/Imu{}{}", path,
                                      others.empty() ? std::string{} : "; its topics are " + others,
                                      end.empty() ? std::string{} : "; it " + end));
    // The frame is named where a topic has several.
    const auto name = [this](const ImuSensor& sensor) {
        const bool is_shared = std::ranges::count(sensors, sensor.topic, &ImuSensor::topic) > 1;
        return is_shared ? fmt::format("{}@{}", sensor.topic, sensor.frame_id) : sensor.topic;
    };
    const auto found = std::ranges::find_if(
        sensors, [&](const ImuSensor& s) { return topic.empty() ? sensors.size() == 1 : name(s) == topic; });
    if (found == sensors.end()) {
        std::string all;
        for (const ImuSensor& sensor : sensors)
            if (all.size() < 300)
                all += fmt::format("{}'{}' ({} messages)", all.empty() ? "" : ", ", shown(name(sensor)),
                                   sensor.n_messages);
        throw MappingError(fmt::format("{}: {}; --map topic=... says which: {}", path,
                                       topic.empty() ? fmt::format("holds {} sensors", sensors.size())
                                                     : fmt::format("has no sensor '{}'", shown(topic)),
                                       all));
    }
    if (found->by_turns)
        throw MappingError(fmt::format("{}: '{}' has messages of several publishers by turns; allowed is one", path,
                                       shown(name(*found))));
    return *found;
}

void check_clocks(const std::string& path, const ImuSensor& sensor) {
    const auto between = [](std::int64_t from, std::int64_t to) {
        return static_cast<double>(to) - static_cast<double>(from);
    };
    const double stamped_ns = between(sensor.first_stamp_ns, sensor.last_stamp_ns);
    const double received_ns = between(sensor.first_received_ns, sensor.last_received_ns);
    if (sensor.n_messages < 3 || !(received_ns > 0.0)) return;
    if (stamped_ns == 0.0)
        throw MappingError(
            fmt::format("{}: the stamps of '{}' stand still; --map time=received takes the times at "
                        "which the messages were recorded",
                        path, shown(sensor.topic)));
    // Clocks differ by less than a thousandth; more may come of a delay that changes.
    const double apart_ns = std::fabs(received_ns - stamped_ns);
    if (apart_ns > 1e-3 * received_ns && apart_ns > sensor.largest_delay_step_ns)
        throw MappingError(
            fmt::format("{}: the messages of '{}' come at {:.6g} Hz by their stamps, and were recorded at "
                        "{:.6g} Hz; --map time=stamp or time=received says which",
                        path, shown(sensor.topic), hz(sensor, stamped_ns), hz(sensor, received_ns)));
}

}  // namespace zlg::logs::bags
