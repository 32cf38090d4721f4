#pragma once
// What an angle log can do, whatever its format.

#include <memory>
#include <zlg/logs/angle_layout.hpp>

namespace zlg::logs {

class AngleSource {
public:
    virtual ~AngleSource() = default;
    virtual bool next(TimedAngle& angle) = 0;
    virtual bool refresh() { return false; }
    [[nodiscard]] virtual double fraction_read() const = 0;
    [[nodiscard]] const AngleHeader& header() const { return header_; }

protected:
    AngleHeader header_;
};

class AngleSink {
public:
    virtual ~AngleSink() = default;
    virtual void write(const TimedAngle& angle) = 0;
    virtual void flush() = 0;
    virtual void close() = 0;
    [[nodiscard]] virtual const std::string& part_path() const = 0;
};

[[nodiscard]] std::unique_ptr<AngleSource> open_angle_csv(const std::string& path);
[[nodiscard]] std::unique_ptr<AngleSource> open_angle_hdf5(const std::string& path);
[[nodiscard]] std::unique_ptr<AngleSink> create_angle_csv(const std::string& path, double tick_s,
                                                          const Settings& settings, bool force,
                                                          const AngleWriterOptions& options);
[[nodiscard]] std::unique_ptr<AngleSink> create_angle_hdf5(const std::string& path, double tick_s,
                                                           const Settings& settings, bool force,
                                                           const AngleWriterOptions& options);

}  // namespace zlg::logs
