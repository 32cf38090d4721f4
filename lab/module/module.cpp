// The closed loop as a module of WebAssembly: what a page calls.
//
// A page writes the settings, text in UTF-8, to where zlg_text tells it and calls zlg_configure, then zlg_advance as often as it likes. A
// function that returns 0 has refused; zlg_message then says why, in the program's own words. Whatever it refuses, the module
// goes on: after a refused configuration with the gyro that it had.

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "loop_run.hpp"

// A function that the page sees under its own name.
#define ZLG_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {

using namespace zlg;

struct Page {
    std::string text;  // of the page
    std::string message;
    std::string fingerprint;
    std::unique_ptr<lab::LoopRun> run;
};

Page& page() {
    static Page the_page;
    return the_page;
}

// The lines that are not empty.
std::vector<std::string> lines(std::string_view text) {
    std::vector<std::string> found;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        if (end != 0) found.emplace_back(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return found;
}

// 1, or 0 with a message where `work` throws.
template <class Work>
int done(const Work& work) {
    try {
        work();
        return 1;
    } catch (const std::exception& error) {
        page().message = error.what();
        return 0;
    }
}

}  // namespace

// Where `bytes` of the page's text go.
ZLG_EXPORT(zlg_text) char* zlg_text(std::size_t bytes) {
    page().text.resize(bytes);
    return page().text.data();
}

// A new gyro, of that text: a line `section.key=value` for each setting, the later over the earlier.
ZLG_EXPORT(zlg_configure) int zlg_configure() {
    return done([] { page().run = std::make_unique<lab::LoopRun>(lab::configured(lines(page().text))); });
}

// So many half-periods of bias, also beyond run.duration_s.
ZLG_EXPORT(zlg_advance) int zlg_advance(std::uint32_t halves) {
    return done([halves] {
        if (!page().run) throw std::logic_error{"no gyro is configured"};
        for (std::uint32_t half = 0; half < halves; ++half) page().run->advance(rig::ignored);
    });
}

// Since the gyro was configured; 0 without one.
ZLG_EXPORT(zlg_time_s) double zlg_time_s() { return page().run ? page().run->time_s() : 0.0; }

// The fingerprint of a run that ends now: 16 hexadecimal digits; null without a gyro.
ZLG_EXPORT(zlg_fingerprint) const char* zlg_fingerprint() {
    if (!page().run) return nullptr;
    page().fingerprint = page().run->fingerprint();
    return page().fingerprint.data();
}

// What was refused last, UTF-8.
ZLG_EXPORT(zlg_message) const char* zlg_message() { return page().message.data(); }
ZLG_EXPORT(zlg_message_bytes) std::size_t zlg_message_bytes() { return page().message.size(); }
