// The closed loop as a module of WebAssembly: what a page calls.
//
// A page writes the settings, text in UTF-8, to where zlg_text tells it and calls zlg_configure, then zlg_advance as
// often as it likes. A function that returns 0 has refused; zlg_message then says why, in the program's own words.
// Whatever it refuses, the module goes on: after a refused configuration with the gyro that it had.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "live_run.hpp"
#include "log_run.hpp"
#include "loop_run.hpp"
#include "schema.hpp"

// A function that the page sees under its own name.
#define ZLG_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {

using namespace zlg;

struct Page {
    std::string text;     // of the page
    std::string message;  // of the module: a refusal, or an answer
    std::string fingerprint;
    config::Config asked;
    std::shared_ptr<lab::HandTurns> hand = std::make_shared<lab::HandTurns>();
    std::unique_ptr<lab::LiveRun> run;
    std::unique_ptr<lab::LogRun> log;
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
template <class Work> int done(const Work& work) {
    try {
        work();
        return 1;
    } catch (const std::exception& error) {
        page().message = error.what();
        return 0;
    }
}

void configure() {
    const std::vector<std::string> settings = lines(page().text);
    config::Config asked = lab::asked(settings);
    page().run = std::make_unique<lab::LiveRun>(lab::configured(settings), page().hand);
    page().asked = std::move(asked);
}

// Those of the gyro, and behind them those of the log.
constexpr std::uint32_t log_ticks = 3;

const std::vector<double>& rows(std::uint32_t view) {
    if (view < log_ticks) return page().run->rows(static_cast<lab::View>(view));
    return view == log_ticks ? page().log->ticks() : page().log->switches();
}

}  // namespace

// Where `bytes` of the page's text go.
ZLG_EXPORT(zlg_text) char* zlg_text(std::size_t bytes) {
    page().text.resize(bytes);
    return page().text.data();
}

// A new gyro, of that text: a line `section.key=value` for each setting, the later over the earlier.
ZLG_EXPORT(zlg_configure) int zlg_configure() { return done(configure); }

// So many half-periods of bias, also beyond run.duration_s.
ZLG_EXPORT(zlg_advance) int zlg_advance(std::uint32_t halves) {
    return done([halves] {
        if (!page().run) throw std::logic_error{"no gyro is configured"};
        for (std::uint32_t half = 0; half < halves; ++half) page().run->advance();
    });
}

// From now on the case also turns at this rate, arcsec/s, in this gyro and, at the same times, in those that are
// configured after it, until zlg_let_go. What a turned gyro does is not what its configuration alone says.
ZLG_EXPORT(zlg_turn) int zlg_turn(double rate_arcsec_s) {
    return done([rate_arcsec_s] {
        if (!page().run) throw std::logic_error{"no gyro is configured"};
        if (!std::isfinite(rate_arcsec_s)) throw std::invalid_argument{"a rate of turn must be a finite number"};
        const double now_s = page().run->run().time_s();
        lab::HandTurns& turns = *page().hand;
        std::erase_if(turns, [now_s](const twin::RateStep& turn) { return turn.at_s >= now_s; });
        turns.push_back({now_s, rate_arcsec_s});
    });
}
ZLG_EXPORT(zlg_let_go) void zlg_let_go() { page().hand->clear(); }

// Since the gyro was configured; 0 without one.
ZLG_EXPORT(zlg_time_s) double zlg_time_s() { return page().run ? page().run->run().time_s() : 0.0; }
ZLG_EXPORT(zlg_halves) double zlg_halves() {
    return page().run ? static_cast<double>(page().run->run().halves()) : 0.0;
}

// Of run.duration_s, 3600 s where it is unset; 0 without a gyro.
ZLG_EXPORT(zlg_run_halves) double zlg_run_halves() {
    return page().run ? static_cast<double>(page().run->run().run_halves()) : 0.0;
}

// The fingerprint of a run that ends now: 16 hexadecimal digits; null without a gyro.
ZLG_EXPORT(zlg_fingerprint) const char* zlg_fingerprint() {
    if (!page().run) return nullptr;
    page().fingerprint = page().run->fingerprint();
    return page().fingerprint.data();
}

// The rows of a view (live_run.hpp: 0 signals, 1 angles, 2 switches; log_run.hpp: 3 ticks, 4 switches) since it was
// forgotten, and how many numbers they are; the numbers of the half before. There must be a gyro, or a log; the place
// holds until either goes on.
ZLG_EXPORT(zlg_rows) const double* zlg_rows(std::uint32_t view) { return rows(view).data(); }
ZLG_EXPORT(zlg_rows_numbers) std::size_t zlg_rows_numbers(std::uint32_t view) { return rows(view).size(); }
ZLG_EXPORT(zlg_forget) void zlg_forget() { page().run->forget(); }
ZLG_EXPORT(zlg_now) const double* zlg_now() { return page().run->now().data(); }

// A log in the file that the page serves (page_file.cpp): the text is the file's name and below it settings, one a
// line.
ZLG_EXPORT(zlg_log) int zlg_log() {
    return done([] {
        const std::vector<std::string> text = lines(page().text);
        page().log = std::make_unique<lab::LogRun>(text.at(0), std::span{text}.subspan(1));
    });
}

// At most so many of its rows: 0 refused, 1 there may be more, 2 it has ended.
ZLG_EXPORT(zlg_log_advance) int zlg_log_advance(std::uint32_t rows) {
    bool goes_on = false;
    const int is_good = done([&] { goes_on = page().log->advance(rows); });
    return is_good != 0 && !goes_on ? 2 : is_good;
}
ZLG_EXPORT(zlg_log_forget) void zlg_log_forget() { page().log->forget(); }
ZLG_EXPORT(zlg_log_fraction) double zlg_log_fraction() { return page().log->fraction_read(); }

// Answers, as zlg_message: what the log is, and what there is to say of it so far, a line each: `raw` or `angles`; the
// length of a tick, s; notes; behind an empty line the settings that differ from the defaults.
ZLG_EXPORT(zlg_log_facts) void zlg_log_facts() {
    const lab::LogRun& log = *page().log;
    page().message = fmt::format("{}\n{}\n{}\n\n{}", log.is_raw() ? "raw" : "angles", log.config().gyro.tick_s,
                                 fmt::join(log.notes(), "\n"), lab::changed_settings(log.config()));
}

// Answers, as zlg_message: the table of keys as JSON, and the settings of the gyro that differ from the defaults, one a
// line.
ZLG_EXPORT(zlg_schema) void zlg_schema() { page().message = lab::schema_json(); }
ZLG_EXPORT(zlg_changed) void zlg_changed() { page().message = lab::changed_settings(page().asked); }

// What was refused, or answered, last, UTF-8.
ZLG_EXPORT(zlg_message) const char* zlg_message() { return page().message.data(); }
ZLG_EXPORT(zlg_message_bytes) std::size_t zlg_message_bytes() { return page().message.size(); }
