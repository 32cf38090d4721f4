// The record of a test as JSON, its seal, and what of it can be verified.

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/acceptance/report.hpp>
#include <zlg/logs/content_hash.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/text/whole_file.hpp>

#include "record.hpp"

namespace zlg::acceptance {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::size_t max_page_bytes = std::size_t{1} << 26;
constexpr std::string_view data_begins = "<script type=\"application/json\" id=\"data\">";
constexpr std::string_view seal_begins = "<!-- zlg accept, XXH64 of all bytes above: ";

ordered_json number(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr); }

template <class Optional> ordered_json optional(const Optional& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json limit_json(const std::optional<Limit>& limit) {
    if (!limit) return nullptr;
    ordered_json j = ordered_json::object();
    if (limit->min) j["min"] = *limit->min;
    if (limit->max) j["max"] = *limit->max;
    return j;
}

ordered_json quantity_json(const Judged& judged) {
    const Value& v = judged.value;
    return {{"name", v.name},
            {"value", number(v.value)},
            {"uncertainty", number(v.uncertainty)},
            {"degrees_of_freedom", number(v.degrees)},
            {"limit", limit_json(judged.limit)},
            {"verdict", judged.verdict ? ordered_json(name_of(*judged.verdict)) : ordered_json(nullptr)},
            {"risk", judged.risk},
            {"more_hours", optional(judged.more_hours)},
            {"hours", v.hours},
            {"reason", v.reason}};
}

ordered_json run_json(const TestedRun& run) {
    ordered_json files = ordered_json::array();
    for (const TestedLog& log : run.logs) files.push_back({{"file", log.file}, {"xxh64", hex(log.checksum)}});
    return {{"number", run.number}, {"kind", name_of(run.kind)}, {"hours", run.hours},
            {"files", files},       {"notes", run.notes},        {"stopped", run.stops}};
}

ordered_json unit_json(const Unit& unit) {
    return {{"serial", unit.serial},
            {"type", unit.type},
            {"operator", unit.operator_name},
            {"equipment", unit.equipment},
            {"date", unit.date},
            {"scale_arcsec", optional(unit.scale_arcsec)},
            {"latitude_deg", optional(unit.latitude_deg)}};
}

std::string whole(const std::string& path) {
    try {
        return text::read_whole(path, max_page_bytes);
    } catch (const text::CannotRead& error) {
        throw logs::IoError(fmt::format("cannot read {}: {}", path, error.what()));
    } catch (const text::TooLong& error) {
        throw logs::FormatError(error.what());
    }
}

std::string seal_of(std::string_view bytes) {
    return fmt::format("{}{} -->\n", seal_begins, hex(logs::content_hash(bytes)));
}

// The text between the tags; empty where there is none.
std::string data_of(const std::string& page) {
    const std::size_t from = page.find(data_begins);
    if (from == std::string::npos) return {};
    const std::size_t begin = from + data_begins.size();
    return page.substr(begin, page.find("</script>", begin) - begin);
}

std::string record_in(const std::string& page, const std::string& path) {
    const std::string record = data_of(page);
    if (record.empty()) throw logs::FormatError(fmt::format("{}: holds no record of an acceptance test", path));
    const std::size_t at = page.rfind(seal_begins);
    if (at == std::string::npos || seal_of(std::string_view{page}.substr(0, at)) != page.substr(at))
        throw logs::FormatError(
            fmt::format("{}: its bytes are not those that zlg accept wrote: it was edited, cut off or damaged", path));
    try {
        const ordered_json shape = ordered_json::parse(record);
        for (const char* key : {"serial", "type", "date"}) (void)shape.at("unit").at(key).get<std::string>();
        for (const auto& q : shape.at("quantities")) (void)q.at("name").get<std::string>();
        for (const auto& run : shape.at("runs")) (void)run.at("files").is_array();
        if (shape.at("passed").is_boolean() && shape.at("plan").contains("xxh64")) return record;
    } catch (const ordered_json::exception&) {
    }
    throw logs::FormatError(fmt::format("{}: its record is not one as zlg {} writes it", path, ZLG_VERSION));
}

}  // namespace

std::string hex(std::uint64_t checksum) { return fmt::format("{:016x}", checksum); }

std::string record_json(const Acceptance& test, const std::string& command) {
    ordered_json runs = ordered_json::array(), all = ordered_json::array();
    for (const TestedRun& run : test.runs) runs.push_back(run_json(run));
    for (const Judged& judged : test.quantities) all.push_back(quantity_json(judged));
    const ordered_json record{
        {"passed", test.passed()},
        {"unit", unit_json(test.plan.unit)},
        {"risk", test.plan.risk},
        {"unit_risk", test.unit_risk ? ordered_json(*test.unit_risk) : ordered_json()},
        {"quantities", all},
        {"runs", runs},
        {"plan", {{"file", fs::path{test.plan.path}.filename().string()}, {"xxh64", hex(test.plan_checksum)}}},
        {"version", ZLG_VERSION},
        {"command", command},
        {"settings", test.settings}};
    return record.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string report_html(const report::Page& page) {
    const std::string html = report::html(page);
    return html + seal_of(html);
}

std::string read_report(const std::string& path) { return record_in(whole(path), path); }

std::vector<std::string> read_reports(const std::string& folder) {
    std::error_code failed, ignored;
    std::vector<std::string> paths, records;
    for (const fs::directory_entry& entry : fs::directory_iterator{folder, failed})
        if (entry.path().extension() == ".html" && !entry.is_directory(ignored)) paths.push_back(entry.path().string());
    if (failed) throw logs::IoError(fmt::format("cannot read the folder {}: {}", folder, failed.message()));
    std::ranges::sort(paths);
    for (const std::string& path : paths)
        if (const std::string page = whole(path); !data_of(page).empty()) records.push_back(record_in(page, path));
    return records;
}

Verification verify(const std::string& report, const std::vector<std::string>& logs) {
    const ordered_json record = ordered_json::parse(read_report(report));
    Verification found;
    found.lines.push_back(fmt::format("{}: whole, as it was written", report));
    std::vector<std::pair<std::string, std::string>> known{{record["plan"]["file"], record["plan"]["xxh64"]}};
    for (const auto& run : record["runs"])
        for (const auto& file : run["files"]) known.emplace_back(file["file"], file["xxh64"]);
    std::vector<std::string> looked_at;
    for (const std::string& log : logs) {
        const std::string checksum = hex(logs::hash_of_file(log));
        const auto same = std::ranges::find(known, checksum, &std::pair<std::string, std::string>::second);
        const bool fits = same != known.end();
        found.fits = found.fits && fits;
        found.lines.push_back(fits ? fmt::format("{}: is {} of the record", log, same->first)
                                   : fmt::format("{}: is none of the record's files as they were", log));
        if (fits) looked_at.push_back(checksum);
    }
    for (const auto& [file, checksum] : known)
        if (std::ranges::find(looked_at, checksum) == looked_at.end())
            found.lines.push_back(fmt::format("{}: was not looked at", file));
    found.lines.emplace_back("this finds damage, not forgery: who can write a page can write its checksum");
    return found;
}

}  // namespace zlg::acceptance
