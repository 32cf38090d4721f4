#pragma once
// The image that this build has made, where the emulator is installed.

#include "test.hpp"

namespace zlg::test {

inline std::optional<std::string> built_image(const std::string& name = "zlg_gyro.elf") {
    const auto image = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "../firmware" / name;
    if (std::system("command -v qemu-system-arm >/dev/null") != 0 || !std::filesystem::is_regular_file(image))
        return {};
    return image.lexically_normal().string();
}

}  // namespace zlg::test
