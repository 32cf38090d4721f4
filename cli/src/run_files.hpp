#pragma once
// The files of a run, in a folder of their own: all of them appear, or none.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/logs/table_file.hpp>
#include <zlg/study/run.hpp>

#include "own_folder.hpp"

namespace zlg::cli {

// Which logs stay beside the summary and the page.
enum class KeptLogs { none, angles, all };

class RunFiles {
public:
    // out  the folder; empty: a new zlg-run-NNN here.
    //
    // errors  logs::IoError: the folder holds one of the files and not `force`, or cannot be made.
    // An error later on leaves the HDF5 logs as they are then, NAME.part; nothing else. A log that is not kept is a
    // file of the run all the same: one of an earlier run must not stay beside the page of this one.
    RunFiles(const std::string& out, bool force, const config::Config& config, logs::LogFormat format, KeptLogs kept,
             int light_samples);
    ~RunFiles();
    RunFiles(const RunFiles&) = delete;
    RunFiles& operator=(const RunFiles&) = delete;

    // Null where they are not kept.
    logs::RawWriter* raw() { return raw_ ? &*raw_ : nullptr; }
    logs::AngleWriter* angles() { return angles_ ? &*angles_ : nullptr; }
    void write_health(std::int64_t half, std::uint32_t bits);
    [[nodiscard]] const std::string& folder() const { return folder_->path(); }

    // The page of the lab beside the report.
    //
    // errors  logs::IoError, as the constructor.
    void add_lab(const std::string& page, bool force);

    // fingerprint  of the run, for the logs.
    void finish(const std::vector<study::SwitchLine>& switches, const std::string& summary, const std::string& page,
                const std::string& fingerprint);

    // Their names, for a reader.
    [[nodiscard]] std::string list() const;
    [[nodiscard]] std::string page() const;

    // Where the logs grow; empty where they are not kept.
    [[nodiscard]] std::string raw_part() const { return raw_ ? raw_->part_path() : ""; }
    [[nodiscard]] std::string angles_part() const { return angles_ ? angles_->part_path() : ""; }

private:
    void open_logs(const config::Config& config, bool force, KeptLogs kept, int light_samples);
    [[nodiscard]] std::string path(std::size_t file) const { return folder_->path(names_[file]); }

    std::optional<OwnFolder> folder_;
    double tick_s_;
    std::array<std::string, 7> names_;
    bool finished_ = false;
    std::vector<std::string> completed_;  // by this run, where nothing stood before
    std::optional<logs::RawWriter> raw_;
    std::optional<logs::AngleWriter> angles_;
    std::map<std::size_t, logs::TableFile> texts_;  // by their place among the names
};

}  // namespace zlg::cli
