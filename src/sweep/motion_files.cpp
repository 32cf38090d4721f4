#include <zlg/sweep/motion_files.hpp>

#include <sys/stat.h>

#include <set>
#include <vector>

#include <fmt/format.h>

#include <zlg/logs/content_hash.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/text/inputs.hpp>

namespace zlg::sweep {
namespace {

// Of the base and of all values that a parameter may give; none where no gyro moves by a file.
std::set<std::string> motion_files(const Description& description) {
    const config::Config base = base_config(description);
    bool moves_by_file = base.motion.kind == config::MotionKind::file;
    std::set<std::string> paths = {base.motion.path};
    for (const Parameter& p : description.parameters) {
        for (const std::string& key : p.keys) {
            if (key != "motion.kind" && key != "motion.path") continue;
            for (const Value& value : p.values) {
                config::Config drawn = base;
                config::apply_pair(drawn, key, toml_of(value), "[[parameter]]");
                moves_by_file = moves_by_file || drawn.motion.kind == config::MotionKind::file;
                paths.insert(drawn.motion.path);
            }
        }
    }
    paths.erase("");
    return moves_by_file ? paths : std::set<std::string>{};
}

}  // namespace

Description with_motion_checksums(Description description) {
    std::map<std::string, std::string> now;
    for (const std::string& path : motion_files(description)) {
        text::note_input(path);
        now[path] = fmt::format("{:016x}", logs::hash_of_file(path));
        const auto before = description.motion_checksums.find(path);
        if (before != description.motion_checksums.end() && before->second != now[path])
            throw logs::IoError(
                fmt::format("the motion file {} has the checksum {} here; allowed is {}, that of the sweep", path,
                            now[path], before->second));
    }
    description.motion_checksums = std::move(now);
    return description;
}

MotionWatch::MotionWatch(const Description& description) {
    for (const auto& [path, checksum] : description.motion_checksums) files_[path] = stamp_of(path);
}

void MotionWatch::require_unchanged() const {
    for (const auto& [path, stamp] : files_)
        if (stamp_of(path) != stamp)
            throw logs::IoError(fmt::format("the motion file {} has changed while the sweep ran", path));
}

MotionWatch::Stamp MotionWatch::stamp_of(const std::string& path) {
    struct stat found {};
    if (::stat(path.c_str(), &found) != 0) return {};
    return {static_cast<std::int64_t>(found.st_dev), static_cast<std::int64_t>(found.st_ino), found.st_size,
            found.st_mtim.tv_sec, found.st_mtim.tv_nsec};
}

}  // namespace zlg::sweep
