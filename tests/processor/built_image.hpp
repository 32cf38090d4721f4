#pragma once
// The image that this build has made, where the emulator is installed.

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <zlg/processor/qemu.hpp>

namespace zlg::test {

inline std::optional<std::string> built_image() {
    if (std::system("command -v qemu-system-arm >/dev/null") != 0) return {};
    try {
        return processor::image_beside(std::filesystem::read_symlink("/proc/self/exe").parent_path());
    } catch (const processor::QemuError&) {
        return {};
    }
}

}  // namespace zlg::test
