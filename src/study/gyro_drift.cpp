#include <zlg/study/gyro_drift.hpp>

#include <string>

#include <zlg/rig/refusal.hpp>

namespace zlg::study {

design::GyroDrift gyro_drift(const config::Config& config) {
    constexpr const char* where = "where an interval is computed: the closed forms know the drift of [drift] alone";
    if (config.field.kind != config::FieldKind::none)
        rig::refuse(config, {"field.kind"}, std::string{"\"none\" "} + where);
    const config::Course& profile = config.temperature.profile;
    if (!profile.path.empty() || !profile.points.empty())
        rig::refuse(config, {"temperature.profile"}, std::string{"none "} + where);
    return RunDrift::law_of(config.drift);
}

}  // namespace zlg::study
