#include "worker.hpp"

#include <exception>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <zlg/sweep/description.hpp>
#include <zlg/sweep/motion_files.hpp>
#include <zlg/sweep/row_text.hpp>

#include "src/interrupt.hpp"

namespace zlg::mpi {
namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// Its first line names the version of the program, as that of a checkpoint does: another one could give other rows.
sweep::Description same_program(const std::string& text) {
    sweep::Description description = sweep::parse(text, "rank 0");
    const std::string here = first_line(to_toml(description));
    if (here != first_line(text))
        throw std::runtime_error(
            fmt::format("rank 0 is `{}`, this machine has `{}`; allowed is one version", first_line(text), here));
    return description;
}

}  // namespace

void Worker::work() {
    cli::will_finish();
    for (;;) {
        read_messages();
        if (is_ended_) return;
        if (cli::is_interrupted()) stop(Tag::stopped);
        if (waiting_.empty())
            sleep_a_moment();
        else
            run_next();
    }
}

void Worker::read_messages() {
    while (const auto message = received()) obey(*message);
}

void Worker::obey(const Message& message) {
    switch (message.tag) {
        case Tag::description: {
            try {
                gyros_.emplace(sweep::with_motion_checksums(same_program(message.text)));
            } catch (const std::exception& error) {
                stop(Tag::failed, error.what());
            }
            break;
        }
        case Tag::gyro:
            if (!is_stopped_) waiting_.push_back(std::stoll(message.text));
            break;
        case Tag::stop: stop(Tag::stopped); break;
        case Tag::end: is_ended_ = true; break;
        default: break;
    }
}

// Messages are read meanwhile, so that a run ends soon that rank 0 stops.
bool Worker::is_stopped() {
    read_messages();
    return is_stopped_ || is_ended_ || cli::is_interrupted();
}

void Worker::run_next() {
    const std::int64_t gyro = waiting_.front();
    waiting_.pop_front();
    try {
        send(0, Tag::row, sweep::text_of(gyros_->run(gyro, [this] { return is_stopped(); })));
    } catch (const sweep::Stopped&) {
        // Said by `stop`, or after it was noted.
    } catch (const std::exception& error) {
        stop(Tag::failed, error.what());
    }
}

// Rank 0 counts on one such message of each rank.
void Worker::stop(Tag why, const std::string& text) {
    waiting_.clear();
    if (!is_stopped_) send(0, why, text);
    is_stopped_ = true;
}

}  // namespace zlg::mpi
