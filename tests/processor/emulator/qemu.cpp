#include <zlg/processor/qemu.hpp>

#include <atomic>
#include <filesystem>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <zlg/firmware/exchange.hpp>
#include <zlg/rig/wire_stream.hpp>

#include "bell.hpp"
#include "child_process.hpp"
#include "shared_memory.hpp"

namespace zlg::processor {
namespace {

using firmware::Exchange;
using firmware::Readiness;
using firmware::Request;

// Of the machine's memory that the exchange lies in; the machine insists on this size.
constexpr std::size_t machine_memory = 16u << 20;

// Where the image keeps its settings.
constexpr unsigned stored_address = 0x3c000;

std::vector<std::string> command_line(const QemuOptions& options, int memory_fd, int bell_fd) {
    std::vector<std::string> words{
        options.program,
        "-M",
        "mps2-an500,memory-backend=exchange",
        "-m",
        "16M",
        "-object",
        fmt::format("memory-backend-file,id=exchange,size=16M,share=on,mem-path=/proc/self/fd/{}", memory_fd),
        "-display",
        "none",
        "-monitor",
        "none",
        "-serial",
        options.line,
        "-serial",
        "null",
        "-chardev",
        fmt::format("socket,id=bell,fd={}", bell_fd),
        "-serial",
        "chardev:bell",
        "-kernel",
        options.image};
    if (!options.stored.empty()) {
        words.emplace_back("-device");
        words.push_back(fmt::format("loader,file={},addr={:#x},force-raw=on", options.stored, stored_address));
    }
    if (options.counts_instructions)
        for (const char* word : {"-icount", "shift=6,sleep=off"}) words.emplace_back(word);
    return words;
}

// Leaves the other program of this core more of it.
void relax() noexcept {
#ifdef __x86_64__
    __builtin_ia32_pause();
#endif
}

void require_image(const std::string& image) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(image, error))
        throw QemuError{fmt::format("{}: is no file; the image of the processor is needed", image)};
}

}  // namespace

// The emulator and the memory through which it is spoken to.
class QemuProcessor::Link {
public:
    explicit Link(const QemuOptions& options)
        : options_{options},
          memory_{machine_memory, sizeof(Exchange)},
          exchange_{std::construct_at(static_cast<Exchange*>(memory_.data()))} {
        require_image(options.image);
        exchange_->host_layout = firmware::layout();
        exchange_->has_line = options.line == "null" ? 0 : 1;
        // Instructions that are counted are not slept away.
        exchange_->has_bell = options.counts_instructions ? 0 : 1;
        exchange_->magic = firmware::lock_step_magic;
        launch();
        await(exchange_->readiness,
              [](std::uint32_t now) { return now != static_cast<std::uint32_t>(Readiness::absent); });
        if (exchange_->readiness.load() == static_cast<std::uint32_t>(Readiness::refused))
            throw QemuError{
                fmt::format("{}: is the image of another version of this program ({:016x}; allowed is {:016x})",
                            options_.image, exchange_->processor_layout, exchange_->host_layout)};
    }

    // What the host has to say must lie in the exchange.
    Exchange& ask(Request request) {
        exchange_->request = request;
        const std::uint32_t number = ++asked_;
        exchange_->asked.store(number);
        if (exchange_->processor_sleeps.load() != 0) bell_.ring();
        await(exchange_->answered, [number](std::uint32_t now) { return now == number; });
        return *exchange_;
    }

    [[nodiscard]] Exchange& exchange() { return *exchange_; }

private:
    void launch() {
        try {
            emulator_.emplace(command_line(options_, memory_.fd(), bell_.other_fd()),
                              std::vector{memory_.fd(), bell_.other_fd()});
            bell_.give_away();
        } catch (const std::system_error& error) {
            throw QemuError{fmt::format("{}: cannot be started: {}; install the package qemu-system-arm",
                                        options_.program, error.code().message())};
        }
    }

    // The answer mostly comes within microseconds. Where it does not, the other side needs this processor, or something
    // may be wrong: wait asleep.
    template <class Good> void await(const std::atomic<std::uint32_t>& word, const Good& good) {
        for (int k = 0; k < n_spins; ++k) {
            if (good(word.load(std::memory_order_acquire))) return;
            relax();
        }
        for (int ms = 0; ms < options_.timeout_ms;) {
            exchange_->host_sleeps.store(1);
            const bool is_there = good(word.load());
            if (!is_there && !bell_.wait(1)) {
                ++ms;
                // It may have gone to sleep while it was asked.
                if (exchange_->processor_sleeps.load() != 0) bell_.ring();
            }
            exchange_->host_sleeps.store(0);
            if (is_there || good(word.load())) return;
            if (emulator_->has_ended()) throw QemuError{fmt::format("{}: {}", options_.program, emulator_->farewell())};
            if (exchange_->readiness.load() == static_cast<std::uint32_t>(Readiness::restarted))
                throw QemuError{
                    fmt::format("{}: the image has begun anew: {}", options_.image, text_of(exchange_->ended).view())};
        }
        throw QemuError{fmt::format("{}: the image {} has not answered for {} ms", options_.program, options_.image,
                                    options_.timeout_ms)};
    }

    static constexpr int n_spins = 4'000;

    QemuOptions options_;
    SharedMemory memory_;
    Bell bell_;
    Exchange* exchange_;
    std::optional<ChildProcess> emulator_;
    std::uint32_t asked_ = 0;
};

QemuProcessor::QemuProcessor(const QemuOptions& options) : link_{std::make_unique<Link>(options)} {}

QemuProcessor::~QemuProcessor() = default;

core::ActuatorFrame QemuProcessor::start(const rig::ProcessorSettings& settings) {
    link_->exchange().settings = {settings.control, settings.compensation};
    return begin(Request::start);
}

core::ActuatorFrame QemuProcessor::start_stored() {
    const core::ActuatorFrame first = begin(Request::start_stored);
    if (link_->exchange().has_stored == 0) throw QemuError{"the image finds no settings in its flash"};
    return first;
}

core::ActuatorFrame QemuProcessor::begin(Request request) {
    link_->exchange().counter = 0;
    link_->exchange().pulse = {};
    first_ticks_.reset();
    const Exchange& answer = link_->ask(request);
    if (answer.fault != firmware::SettingsFault{})
        throw QemuError{fmt::format("the image refuses its settings: control {}, compensation {}",
                                    static_cast<int>(answer.fault.control),
                                    static_cast<int>(answer.fault.compensation))};
    return answer.first_actuator;
}

rig::ProcessorHalf QemuProcessor::half(const core::SensorFrame& frame) {
    link_->exchange().sensor = frame;
    if ((frame.status & core::frame_missed) == 0) give_pulse(frame.timer_ticks);
    const Exchange& answer = link_->ask(Request::half);
    return {answer.output.control, answer.output.compensation};
}

// The clock outside is that of rig::WireStream.
void QemuProcessor::give_pulse(std::uint64_t now_ticks) {
    if (!first_ticks_) first_ticks_ = now_ticks;
    const std::uint64_t n_before = (now_ticks - *first_ticks_) / rig::pulse_ticks;
    link_->exchange().pulse = {.n = static_cast<std::uint32_t>(n_before + 1),
                               .stamp_ticks = *first_ticks_ + n_before * rig::pulse_ticks};
}

core::DrainOutput QemuProcessor::drain() { return link_->ask(Request::drain).drained; }

firmware::GyroState QemuProcessor::state() { return link_->ask(Request::state).state; }

std::uint32_t QemuProcessor::stack_used_bytes() { return link_->ask(Request::state).stack_used_bytes; }

}  // namespace zlg::processor
