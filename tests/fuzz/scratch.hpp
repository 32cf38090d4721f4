#pragma once
// A folder of this process for the files that a reader reads. It goes away with the process, unless that crashes.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace zlg::fuzz {

class Scratch {
public:
    Scratch() : folder_{std::filesystem::temp_directory_path() / ("zlg-fuzz-" + std::to_string(::getpid()))} {
        std::filesystem::create_directory(folder_);
    }
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    [[nodiscard]] std::string path(const char* name) const { return folder_ / name; }

    // The bytes as a file; gives its path.
    [[nodiscard]] std::string write(const char* name, const std::uint8_t* data, std::size_t size) const {
        std::ofstream file{folder_ / name, std::ios::binary | std::ios::trunc};
        for (std::size_t k = 0; k < size; ++k) file.put(static_cast<char>(data[k]));
        return path(name);
    }

private:
    std::filesystem::path folder_;
};

inline const Scratch& scratch() {
    static const Scratch folder;
    return folder;
}

}  // namespace zlg::fuzz
