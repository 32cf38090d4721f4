#include "processor_option.hpp"

#include <filesystem>

#include <fmt/format.h>

#include <zlg/processor/qemu.hpp>

#include "failure.hpp"

namespace zlg::cli {
namespace {

std::string own_folder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

}  // namespace

void add_processor_options(CLI::App& verb, ProcessorOptions& options) {
    verb.add_option("--processor", options.processor,
                    "what runs the core: host (default), or qemu, the image of the gyro's processor in lock step");
    verb.add_option("--image", options.image,
                    "the image of the processor, ELF; the one built with this program without it");
}

std::unique_ptr<rig::Processor> make_processor(const ProcessorOptions& options) {
    if (options.processor == "host") {
        if (!options.image.empty()) throw UsageError{"--image: is for --processor qemu"};
        return nullptr;
    }
    if (options.processor != "qemu")
        throw UsageError{fmt::format("--processor {}: allowed are host and qemu", options.processor)};
    const std::string image = options.image.empty() ? processor::image_beside(own_folder()) : options.image;
    return std::make_unique<processor::QemuProcessor>(processor::QemuOptions{.image = image});
}

}  // namespace zlg::cli
