// The table of keys as JSON.
#include "schema.hpp"

#include <cmath>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/core/health.hpp>
#include <zlg/core/records.hpp>
#include <zlg/twin/fault_kinds.hpp>

namespace zlg::lab {
namespace {

// The texts of the table hold no control characters.
std::string json_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

template <class Range, class Text> std::string list(const Range& range, const Text& text) {
    std::string out = "[";
    for (const auto& each : range) {
        if (out.size() > 1) out += ",";
        out += text(each);
    }
    return out + "]";
}

std::string key_json(const config::KeyInfo& key) {
    return fmt::format(
        R"({{"section":{},"name":{},"unit":{},"meaning":{},"default":{},"allowed":{},"kind":"{}","choices":{}}})",
        json_text(key.section), json_text(key.name), json_text(key.unit), json_text(key.meaning),
        json_text(key.default_text), json_text(key.allowed),
        config::value_kind_names.at(static_cast<std::size_t>(key.kind)), list(key.choices, json_text));
}

std::string fault_json(const twin::FaultFacts& fault) {
    return fmt::format(R"({{"name":{},"unit":{},"least":{},"most":{},"duration_s":{:.2g}}})", json_text(fault.name),
                       json_text(fault.unit), fault.random_size.least, fault.random_size.most,
                       std::sqrt(fault.random_s.least * fault.random_s.most));
}

}  // namespace

std::string schema_json() {
    return fmt::format(R"({{"keys":{},"health":{},"angle_flags":{},"faults":{}}})",
                       list(config::describe_keys(), key_json), list(core::health_bit_names, json_text),
                       list(core::angle_flag_names, json_text), list(twin::fault_table, fault_json));
}

std::string changed_settings(const config::Config& config) {
    std::string out;
    for (const auto& [key, value] : config::changed_settings(config)) out += fmt::format("{}={}\n", key, value);
    return out;
}

}  // namespace zlg::lab
