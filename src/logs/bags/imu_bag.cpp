// The angle log as messages of an IMU whose axis z is that of the gyro.

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <zlg/logs/error.hpp>

#include "imu_message.hpp"
#include "log_io.hpp"
#include "mcap_writer.hpp"
#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

class ImuBagSink final : public LogSink<AngleTable> {
public:
    ImuBagSink(const std::string& path, double tick_s, bool force)
        : file_{path, "/imu", "sensor_msgs/msg/Imu", bags::imu_definition, force}, tick_s_{tick_s} {
        if (!(tick_s > 0.0)) throw FormatError(fmt::format("{}: tick_s is not known, and a rate needs it", path));
    }

    // The mean rate over the tick, which is that of its middle; of a tick that was not measured there is none.
    void write(const TimedAngle& angle, const core::LightSamples&) override {
        require_loggable<AngleTable>(angle, {});
        const double rad_s = std::numbers::pi / (180.0 * 3600.0) / tick_s_;  // of an arc second
        const double sigma = angle.row.sigma_arcsec * rad_s;
        const bool is_known = (angle.row.flags & core::flag_unrepaired) == 0;
        const double rate = is_known ? angle.row.dtheta_final_arcsec * rad_s : std::numeric_limits<double>::quiet_NaN();
        const std::int64_t ns = std::llround((angle.t_s - tick_s_ / 2.0) * 1e9);
        file_.write(static_cast<std::uint64_t>(ns), bags::imu_cdr(ns, "zlg", rate, sigma * sigma));
    }

    void flush() override {}
    void set_fingerprint(const std::string&) override { refuse_fingerprint(part_path()); }
    void close() override { file_.close(); }
    [[nodiscard]] const std::string& part_path() const override { return file_.part_path(); }

private:
    bags::McapWriter file_;
    double tick_s_;
};

}  // namespace

std::unique_ptr<LogSink<AngleTable>> create_imu_bag(const std::string& path, double tick_s, bool force) {
    return std::make_unique<ImuBagSink>(path, tick_s, force);
}

}  // namespace zlg::logs
