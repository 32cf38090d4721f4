#pragma once
// A folder for files that may yet fail, and the folder of the program.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/logs/unfinished.hpp>

namespace zlg::cli {

// Where the program lies.
[[nodiscard]] inline std::string program_folder() {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

// Made if it is not there, and removed at the end if it was made and nothing is in it. A signal finds it either not
// made or known as new.
class OwnFolder {
public:
    // errors  logs::IoError: it cannot be made.
    explicit OwnFolder(std::string path) : path_{std::move(path)} {
        const logs::Together made_and_known;
        std::error_code error;
        is_new_ = std::filesystem::create_directory(path_, error);
        if (error) throw logs::IoError{fmt::format("{}: cannot make the folder: {}", path_, error.message())};
        if (is_new_) known_.emplace(path_);
    }
    ~OwnFolder() {
        std::error_code ignored;
        if (is_new_) std::filesystem::remove(path_, ignored);
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;

    [[nodiscard]] bool is_new() const { return is_new_; }
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::string path(const std::string& name) const { return std::filesystem::path{path_} / name; }

private:
    std::string path_;
    bool is_new_ = false;
    std::optional<logs::NewFolder> known_;
};

}  // namespace zlg::cli
