// A bag as a table: the messages of one IMU, its stamps and its rates.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <zlg/logs/budget.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/file_nature.hpp>

#include "byte_stream.hpp"
#include "foreign/foreign_readers.hpp"
#include "imu_survey.hpp"

namespace zlg::logs {

namespace {

using namespace bags;

constexpr std::array<const char*, 5> bag_columns{"stamp [ns]", "received [ns]", "angular_velocity.x [rad/s]",
                                                 "angular_velocity.y [rad/s]", "angular_velocity.z [rad/s]"};
using BagRow = std::array<double, bag_columns.size()>;

// Nanoseconds from the first message on are whole numbers that a double holds.
double ns_since(std::int64_t first, std::int64_t ns) {
    return static_cast<double>(
        static_cast<std::int64_t>(static_cast<std::uint64_t>(ns) - static_cast<std::uint64_t>(first)));
}

struct ImuRows {
    std::string path;
    ReadBag read_bag;
    ImuSensor sensor;
    std::vector<std::size_t> columns = {0, 1};  // of `bag_columns`; further the rates that the sensor measures

    // Calls take(row) with the messages of the sensor, at most so many.
    template <class Take> void read(std::uint64_t n, Take take) const {
        struct Enough {};
        try {
            (void)read_bag(path, [&](const BagMessage& message) {
                if (n == 0) throw Enough{};
                if (!message.channel.is_imu()) return;
                const ImuMessage imu = imu_message(message.data, message.channel.encoding);
                if (!sensor.is(message.channel, imu)) return;
                take(BagRow{ns_since(sensor.first_stamp_ns, imu.stamp_ns),
                            ns_since(sensor.first_received_ns, message.received_ns), imu.rate_rad_s[0],
                            imu.rate_rad_s[1], imu.rate_rad_s[2]});
                --n;
            });
        } catch (const Enough&) {
        }
    }

    [[nodiscard]] TextColumn column(std::int64_t number) const {
        return {.number = number, .name = names().at(static_cast<std::size_t>(number - 1)), .values = {}};
    }

    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const std::size_t column : columns) all.emplace_back(bag_columns.at(column));
        return all;
    }

    [[nodiscard]] TextTable table(const std::vector<std::int64_t>& wanted, std::int64_t times) const {
        TextTable all;
        for (const std::int64_t number : wanted) all.columns.push_back(column(number));
        if (times > 0) {
            all.times = column(times);
            all.times->origin = static_cast<double>(times == 1 ? sensor.first_stamp_ns : sensor.first_received_ns);
        }
        const auto put = [this](TextColumn& to, const BagRow& row) {
            to.values.push_back(row.at(columns.at(static_cast<std::size_t>(to.number - 1))));
        };
        read(sensor.n_messages, [&](const BagRow& row) {
            for (TextColumn& to : all.columns) put(to, row);
            if (all.times) put(*all.times, row);
        });
        return all;
    }
};

std::string seconds(std::int64_t ns) {
    constexpr std::int64_t in_a_second = 1'000'000'000;
    return fmt::format("{}{}.{:09}", ns < 0 ? "-" : "", std::abs(ns / in_a_second), std::abs(ns % in_a_second));
}

}  // namespace

ForeignTable bag_table_of(const std::string& path, const Mapping& mapping) {
    const std::string nature = foreign_nature(path);
    const ReadBag read_bag = nature.starts_with("a ROS bag") ? &read_rosbag : &read_mcap;
    const ImuSurvey survey = surveyed(path, read_bag);
    ImuRows rows{.path = path, .read_bag = read_bag, .sensor = survey.chosen(path, mapping.text("topic"))};
    for (std::size_t k = 0; k < rows.sensor.has_rate.size(); ++k)
        if (rows.sensor.has_rate[k]) rows.columns.push_back(2 + k);
    if (!mapping.has("time")) check_clocks(path, rows.sensor);
    ForeignTable table{.path = path,
                       .nature = fmt::format("{}, messages of '{}'", nature, rows.sensor.topic),
                       .columns = {},
                       .notes = {},
                       .n_rows = static_cast<std::int64_t>(rows.sensor.n_messages),
                       .read = {}};
    for (const std::string& name : rows.names())
        table.columns.push_back({.number = std::ssize(table.columns) + 1, .name = name, .first = {}, .values = {}});
    rows.read(max_looked_at / bag_columns.size(), [&](const BagRow& row) {
        for (std::size_t c = 0; c < table.columns.size(); ++c)
            table.columns[c].values.push_back(row.at(rows.columns[c]));
    });
    for (ForeignColumn& column : table.columns) column.first = fmt::format("{}", column.values.front());
    if (!survey.end.empty()) table.notes.push_back("it " + survey.end);
    table.notes.push_back(fmt::format("'{}' of frame '{}': stamp counts from {} s on, received from {} s on",
                                      rows.sensor.topic, rows.sensor.frame_id, seconds(rows.sensor.first_stamp_ns),
                                      seconds(rows.sensor.first_received_ns)));
    if (!survey.others.empty()) table.notes.push_back("left out are " + survey.others);
    table.read = [rows](const std::vector<std::int64_t>& wanted, std::int64_t times) {
        return rows.table(wanted, times);
    };
    return table;
}

}  // namespace zlg::logs
