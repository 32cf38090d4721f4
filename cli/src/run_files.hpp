#pragma once
// The files of a run, in a folder of their own.

#include <optional>
#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/study/run.hpp>

namespace zlg::cli {

class RunFiles {
public:
    // out  the folder; empty: a new zlg-run-NNN here.
    //
    // errors  logs::IoError: the folder holds one of the files and not `force`, or cannot be made.
    RunFiles(const std::string& out, bool force, const config::Config& config);
    ~RunFiles();

    logs::RawWriter& raw() { return *raw_; }
    logs::AngleWriter& angles() { return *angles_; }
    [[nodiscard]] const std::string& folder() const { return folder_; }

    // All files appear under their names.
    void finish(const std::vector<study::SwitchLine>& switches, const std::string& summary, const std::string& page);

    [[nodiscard]] static std::string list();

private:
    [[nodiscard]] std::string path(const char* name) const;
    void write_text(const char* name, const std::string& text) const;

    std::string folder_;
    bool force_;
    bool made_folder_ = false;
    bool finished_ = false;
    std::optional<logs::RawWriter> raw_;
    std::optional<logs::AngleWriter> angles_;
};

}  // namespace zlg::cli
