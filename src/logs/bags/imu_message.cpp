#include "imu_message.hpp"

#include <fmt/format.h>

#include <limits>

#include "fields.hpp"

namespace zlg::logs::bags {

namespace {

constexpr std::int64_t ns_in_a_second = 1'000'000'000;

// The fields of a message. In CDR each number stands at a multiple of its size, counted from behind the four bytes that
// name the form.
class MessageFields {
public:
    MessageFields(std::string_view data, bool is_cdr) : fields_{data}, is_cdr_{is_cdr} {
        if (!is_cdr) return;
        (void)fields_.number<std::uint8_t>();
        const auto form = fields_.number<std::uint8_t>();
        if (form > 1) throw Damaged(fmt::format("has a message in form {} of CDR; allowed are 0 and 1", form));
        is_swapped_ = form == 0;
        (void)fields_.bytes(2);
        size_ = fields_.left();
    }

    template <class Number> Number number() {
        const std::size_t at = size_ - fields_.left();
        if (is_cdr_) (void)fields_.bytes((sizeof(Number) - at % sizeof(Number)) % sizeof(Number));
        return fields_.number<Number>(is_swapped_);
    }

    std::string_view text() { return fields_.bytes(number<std::uint32_t>()); }

    [[nodiscard]] std::size_t left() const { return fields_.left(); }

private:
    Fields fields_;
    bool is_cdr_;
    bool is_swapped_ = false;
    std::size_t size_ = 0;
};

}  // namespace

ImuMessage imu_message(std::string_view data, std::string_view encoding) {
    const bool is_cdr = encoding == "cdr";
    MessageFields fields{data, is_cdr};
    const auto skip_numbers = [&fields](int n) {
        for (int k = 0; k < n; ++k) (void)fields.number<double>();
    };
    ImuMessage message;
    if (!is_cdr) (void)fields.number<std::uint32_t>();  // in sequence
    const std::int64_t seconds = is_cdr ? fields.number<std::int32_t>() : std::int64_t{fields.number<std::uint32_t>()};
    const auto ns = std::int64_t{fields.number<std::uint32_t>()};
    if (ns >= ns_in_a_second)
        throw Damaged(fmt::format("has a message with a stamp of {} ns beside seconds; allowed is below 1e9", ns));
    message.stamp_ns = seconds * ns_in_a_second + ns;
    message.frame_id = fields.text();
    if (is_cdr && message.frame_id.ends_with('\0')) message.frame_id.remove_suffix(1);
    constexpr int in_orientation = 4 + 9, in_acceleration = 3 + 9, in_covariance = 9;
    skip_numbers(in_orientation);
    for (double& rate : message.rate_rad_s) rate = fields.number<double>();
    if (fields.number<double>() == -1.0) message.rate_rad_s.fill(std::numeric_limits<double>::quiet_NaN());
    skip_numbers(in_covariance - 1 + in_acceleration);
    // Some writers of CDR fill words up.
    if (fields.left() > (is_cdr ? 3 : 0))
        throw Damaged(fmt::format("has a message with {} bytes behind those of sensor_msgs/Imu; allowed are none",
                                  fields.left()));
    return message;
}

const std::string_view imu_definition =
    R"(std_msgs/Header header
geometry_msgs/Quaternion orientation
float64[9] orientation_covariance
geometry_msgs/Vector3 angular_velocity
float64[9] angular_velocity_covariance
geometry_msgs/Vector3 linear_acceleration
float64[9] linear_acceleration_covariance
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
================================================================================
MSG: geometry_msgs/Quaternion
float64 x 0
float64 y 0
float64 z 0
float64 w 1
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
)";

std::string imu_cdr(std::int64_t stamp_ns, std::string_view frame_id, double rate_rad_s, double variance_rad2_s2) {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    constexpr double unknown = std::numeric_limits<double>::infinity();
    std::string out{"\0\1\0\0", 4};
    put(out, static_cast<std::int32_t>(stamp_ns / ns_in_a_second));
    put(out, static_cast<std::uint32_t>(stamp_ns % ns_in_a_second));
    put(out, static_cast<std::uint32_t>(frame_id.size() + 1));
    out += frame_id;
    do out += '\0';
    while ((out.size() - 4) % sizeof(double) != 0);
    const auto put_all = [&out](std::initializer_list<double> values) {
        for (const double value : values) put(out, value);
    };
    put_all({0.0, 0.0, 0.0, 1.0});
    put_all({-1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
    put_all({nothing, nothing, rate_rad_s});
    put_all({unknown, 0.0, 0.0, 0.0, unknown, 0.0, 0.0, 0.0, variance_rad2_s2});
    put_all({0.0, 0.0, 0.0});
    put_all({-1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
    return out;
}

}  // namespace zlg::logs::bags
