#include "interrupt.hpp"

#include <csignal>

#include <zlg/logs/error.hpp>

namespace zlg::cli {
namespace {

volatile std::sig_atomic_t noted = 0;

void note(int signal) {
    noted = 1;
    std::signal(signal, SIG_DFL);
}

}  // namespace

Interruptible::Interruptible() {
    noted = 0;
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
}

Interruptible::~Interruptible() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

void Interruptible::check() const {
    if (noted) throw logs::IoError{"interrupted by a signal"};
}

bool Interruptible::is_noted() const { return noted != 0; }

}  // namespace zlg::cli
