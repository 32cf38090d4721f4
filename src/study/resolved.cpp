#include <zlg/study/resolved.hpp>

#include <utility>

#include <fmt/format.h>

#include <zlg/logs/text_columns.hpp>
#include <zlg/recorded/environment.hpp>
#include <zlg/rig/laser_agreement.hpp>
#include <zlg/study/design_study.hpp>
#include <zlg/study/switch_trial.hpp>

namespace zlg::study {
namespace {

std::string whole_drift_note(const config::Config& config) {
    if (config.compensation.magnetic != core::MagneticMethod::estimate) return "";
    return "; the whole magnetic drift is in it, for how much of it compensation.magnetic = \"estimate\" takes out is "
           "not foreseen: a longer interval may be better";
}

}  // namespace

Resolved resolved(const config::Config& config) {
    rig::LaserAgreement agreement = rig::agreed_with_laser(recorded::with_environment(config));
    Resolved made{.config = std::move(agreement.config),
                  .notes = std::move(agreement.notes),
                  .warnings = std::move(agreement.warnings)};
    const config::Motion& motion = config.motion;
    if (motion.kind == config::MotionKind::file && !logs::ends_with_a_line(motion.path))
        made.warnings.push_back(
            fmt::format("{}: the last line has no end; the file may have been cut off", motion.path));
    if (!made.config.switching.interval_optimal) return made;
    const SwitchCost cost = switch_cost(made.config);
    made.config = with_interval(made.config, cost.error_arcsec);
    made.notes.push_back(fmt::format(
        "switching.interval_s = \"optimal\" is {:.4g} s here, by [drift] and {:.3g} arcsec a switch, {}{}",
        made.config.switching.interval_s, cost.error_arcsec, text(cost.source), whole_drift_note(made.config)));
    return made;
}

}  // namespace zlg::study
