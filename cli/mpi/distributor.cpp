#include "distributor.hpp"

#include <algorithm>
#include <string>
#include <thread>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/sweep/row_text.hpp>

#include "src/interrupt.hpp"

namespace zlg::mpi {

Distributor::Distributor(const sweep::Gyros& gyros, const std::vector<std::int64_t>& asked,
                         const std::function<void(sweep::Row)>& take)
    : gyros_{gyros}, asked_{asked}, take_{take}, others_(static_cast<std::size_t>(n_ranks())) {}

bool Distributor::run() {
    cli::will_finish();
    const std::string description = to_toml(gyros_.description());
    for (int rank = 1; rank < n_ranks(); ++rank) send(rank, Tag::description, description);
    std::thread here{[this] { run_here(); }};
    serve_all();
    here.join();
    if (error_) std::rethrow_exception(error_);
    return !stops_;
}

void Distributor::serve_all() {
    for (int rank = 1; rank < n_ranks(); ++rank) serve(rank);
    while (!is_done_here_ || !is_everybody_idle()) {
        if (cli::is_interrupted()) stops_ = true;
        if (stops_) stop_all();
        bool is_quiet = true;
        for (; const auto message = received(); is_quiet = false) obey(*message);
        if (is_quiet) sleep_a_moment();
    }
}

void Distributor::serve(int rank) {
    int& n_in_hand = others_[static_cast<std::size_t>(rank)].n_in_hand;
    while (!stops_ && (n_in_hand == 0 || (n_in_hand == 1 && n_left() > others_.size()))) {
        const auto gyro = next();
        if (!gyro) return;
        send(rank, Tag::gyro, std::to_string(*gyro));
        ++n_in_hand;
    }
}

void Distributor::obey(const Message& message) {
    Other& other = others_[static_cast<std::size_t>(message.rank)];
    if (message.tag == Tag::row) {
        --other.n_in_hand;
        try {
            auto row = sweep::row_of(message.text, gyros_.description().metrics.size());
            if (!row) throw logs::IoError{fmt::format("rank {} sent what is no row: {}", message.rank, message.text)};
            take_(std::move(*row));
        } catch (...) {
            fail(std::current_exception());
        }
        return serve(message.rank);
    }
    other.is_stopped = true;
    if (message.tag == Tag::failed)
        fail(std::make_exception_ptr(logs::IoError{fmt::format("rank {}: {}", message.rank, message.text)}));
    stops_ = true;
}

void Distributor::run_here() {
    try {
        while (const auto gyro = next()) take_(gyros_.run(*gyro, [this] { return stops_.load(); }));
    } catch (const sweep::Stopped&) {
        // What `stops_` asked for.
    } catch (...) {
        fail(std::current_exception());
    }
    is_done_here_ = true;
}

void Distributor::stop_all() {
    if (has_sent_stop_) return;
    has_sent_stop_ = true;
    for (int rank = 1; rank < n_ranks(); ++rank) send(rank, Tag::stop);
}

void Distributor::fail(std::exception_ptr error) {
    const std::scoped_lock lock{shared_};
    if (!error_) error_ = std::move(error);
    stops_ = true;
}

std::optional<std::int64_t> Distributor::next() {
    const std::scoped_lock lock{shared_};
    if (stops_ || n_given_ == asked_.size()) return std::nullopt;
    return asked_[n_given_++];
}

std::size_t Distributor::n_left() {
    const std::scoped_lock lock{shared_};
    return asked_.size() - n_given_;
}

// The rows that come before the last `stopped` are taken.
bool Distributor::is_everybody_idle() const {
    return std::all_of(others_.begin() + 1, others_.end(),
                       [&](const Other& other) { return stops_ ? other.is_stopped : other.n_in_hand == 0; });
}

bool run_on_all_ranks(const sweep::Gyros& gyros, const std::vector<std::int64_t>& asked,
                      const std::function<void(sweep::Row)>& take) {
    return Distributor{gyros, asked, take}.run();
}

}  // namespace zlg::mpi
