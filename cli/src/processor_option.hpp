#pragma once
// Which processor runs the core: this program, or the image of the gyro's own.

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include <zlg/rig/processor.hpp>

namespace zlg::cli {

struct ProcessorOptions {
    std::string processor = "host";
    std::string image;  // empty: the one beside the program
};

void add_processor_options(CLI::App& verb, ProcessorOptions& options);

// return  null for the host.
//
// errors  UsageError for an unknown processor, or an image for the host; processor::QemuError.
[[nodiscard]] std::unique_ptr<rig::Processor> make_processor(const ProcessorOptions& options);

}  // namespace zlg::cli
