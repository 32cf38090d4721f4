#include <zlg/recorded/environment.hpp>

#include <cstdint>
#include <vector>

#include <zlg/config/schema.hpp>
#include <zlg/logs/text_columns.hpp>

namespace zlg::recorded {
namespace {

// Up to ten days of a row a second.
void read_points(config::Course& course, const char* section) {
    if (course.path.empty()) return;
    const logs::TextLayout layout{
        .columns = {1, 2}, .section = section, .max_rows = 1'000'000, .max_bytes = std::int64_t{1} << 28};
    const std::vector<std::vector<double>> columns = logs::read_text_columns(course.path, layout);
    course.points.resize(columns.front().size());
    for (std::size_t k = 0; k < course.points.size(); ++k) course.points[k] = {columns[0][k], columns[1][k]};
}

}  // namespace

config::Config with_environment(config::Config config) {
    read_points(config.gyro.bias_temperature_table, "gyro");
    read_points(config.temperature.profile, "temperature");
    if (config.field.kind == config::FieldKind::file) read_points(config.field.course, "field");
    config::check_environment(config);
    return config;
}

}  // namespace zlg::recorded
