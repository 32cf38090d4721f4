// Every method of compensation against the bound: tables in Markdown to stdout, and with --out a page.
//
// usage: zlg_accuracy [--quick] [--share R] [--long] [--out DIR] [--seed N] [--threads N]
//                     [--motion FILE [--columns 1,2,3] [--rate-hz R] [--scale ARCSEC] [--count ARCSEC] [--holds-rate]
//                      [--comment TEXT] [--skip-lines N]]...
//
// The number of threads changes no figure. Exit 1 where a criterion is not met.

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <zlg/logs/table_file.hpp>
#include <zlg/report/page.hpp>
#include <zlg/trials/accuracy.hpp>

namespace {

using namespace zlg;

struct Call {
    trials::AccuracyTask task;
    std::string out;
};

double number(std::string_view option, std::string_view text) {
    double x = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (error != std::errc{} || end != text.data() + text.size())
        throw std::invalid_argument(fmt::format("{}: '{}', allowed is a number", option, text));
    return x;
}

std::vector<int> numbers(std::string_view option, std::string_view text) {
    std::vector<int> all;
    while (!text.empty()) {
        const std::size_t length = std::min(text.find(','), text.size());
        all.push_back(static_cast<int>(number(option, text.substr(0, length))));
        text.remove_prefix(std::min(length + 1, text.size()));
    }
    return all;
}

bool take_of_motion(trials::Recording& r, std::string_view option, std::string_view value) {
    if (option == "--columns")
        r.columns = numbers(option, value);
    else if (option == "--rate-hz")
        r.rate_hz = number(option, value);
    else if (option == "--scale")
        r.scale_arcsec = number(option, value);
    else if (option == "--count")
        r.count_arcsec = number(option, value);
    else if (option == "--comment")
        r.comment = value;
    else if (option == "--skip-lines")
        r.skip_lines = static_cast<int>(number(option, value));
    else
        return false;
    return true;
}

bool take(Call& call, std::string_view option, std::string_view value) {
    std::vector<trials::Recording>& recordings = call.task.recordings;
    if (option == "--out")
        call.out = value;
    else if (option == "--share")
        call.task.share = number(option, value);
    else if (option == "--seed")
        call.task.seed = static_cast<std::uint64_t>(number(option, value));
    else if (option == "--threads")
        call.task.threads = static_cast<int>(number(option, value));
    else if (option == "--motion")
        recordings.push_back({.name = std::filesystem::path{value}.filename().string(), .path = std::string{value}});
    else
        return !recordings.empty() && take_of_motion(recordings.back(), option, value);
    return true;
}

Call call_of(int argc, char** argv) {
    Call call;
    for (int k = 1; k < argc; ++k) {
        const std::string_view option = argv[k];
        if (option == "--quick") {
            call.task.quick = true;
        } else if (option == "--long") {
            call.task.long_runs = true;
        } else if (option == "--holds-rate" && !call.task.recordings.empty()) {
            call.task.recordings.back().holds_rate = true;
        } else if (k + 1 < argc && take(call, option, argv[k + 1])) {
            ++k;
        } else {
            throw std::invalid_argument(fmt::format("argument '{}' is not known here or lacks its value", option));
        }
    }
    return call;
}

void write(const std::filesystem::path& path, const std::string& text) {
    logs::TableFile file{path.string(), true};
    file.append(text);
    file.close();
}

int run(Call call) {
    int shown = -1;
    call.task.on_progress = [&](double share) {
        const int percent = static_cast<int>(100.0 * share);
        if (percent >= shown + 5) std::cerr << fmt::format("{} %\n", shown = percent);
    };
    const trials::Accuracy accuracy = trials::measure_accuracy(call.task);
    const std::string text = trials::markdown(accuracy);
    fmt::print("{}", text);
    if (!call.out.empty()) {
        std::filesystem::create_directories(call.out);
        write(std::filesystem::path{call.out} / "accuracy.md", text);
        write(std::filesystem::path{call.out} / "accuracy.html", report::html(trials::accuracy_page(accuracy)));
    }
    return std::ranges::all_of(accuracy.criteria,
                               [](const trials::Criterion& c) { return c.verdict != trials::Verdict::missed; })
               ? 0
               : 1;
}

}  // namespace

int main(int argc, char** argv) {
    Call call;
    try {
        call = call_of(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "zlg_accuracy: " << error.what() << "\n";
        return 2;
    }
    try {
        return run(call);
    } catch (const std::exception& error) {
        std::cerr << "zlg_accuracy: " << error.what() << "\n";
        return 3;
    }
}
