#include <zlg/recorded/motion.hpp>

#include <zlg/rig/wiring.hpp>

#include "motion_file.hpp"

namespace zlg::recorded {

twin::Motion motion(const config::Config& config) {
    return config.motion.kind == config::MotionKind::file ? motion_of_file(config.motion) : rig::motion(config);
}

}  // namespace zlg::recorded
