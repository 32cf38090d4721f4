// A plan to begin with.

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

#include <zlg/acceptance/plan.hpp>
#include <zlg/acceptance/quantity.hpp>
#include <zlg/logs/imported.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/text/escape.hpp>
#include <zlg/text/toml_text.hpp>

namespace zlg::acceptance {
namespace {

constexpr const char* head = R"(# The plan of an acceptance test: zlg accept THIS_FILE --out report.html
# Names of files count from the folder of this file. docs/acceptance.md has every key.

[unit]
serial = "unknown"      # of the gyro; a log that says another one is refused
type = ""               # reports of one type are a trend (--history)
operator = ""
equipment = ""
date = ""               # of the test, as the report shows it
# scale_arcsec = 3.263  # nominal, arcsec per count
# latitude_deg = 55.75  # with axis = "up", "north", ... of a run the Earth's rotation is taken out of the bias
)";

std::string mapping_lines(const std::string& path) {
    const logs::ForeignLook look = logs::look_at_foreign(path, {});
    std::string text;
    std::istringstream lines{look.mapping.toml()};
    for (std::string line; std::getline(lines, line);)
        text += (line.starts_with("axis = ") ? "# column = " + line.substr(7) : line) + "\n";
    for (const std::string& missing : look.missing) text += fmt::format("# missing: {}\n", text::escaped(missing));
    return text;
}

std::string run_text(const std::string& path) {
    std::string text = fmt::format(
        "\n[[run]]\nfiles = [{}]\nkind = \"static\"  # or rate_table, warm_up, magnetic, temperature, switching\n",
        text::toml_string(path));
    return logs::recognise(path) == logs::LogKind::unknown ? text + mapping_lines(path) : text;
}

}  // namespace

std::string plan_for(const std::vector<std::string>& logs) {
    std::string text = head;
    for (const std::string& log : logs) text += run_text(log);
    text +=
        "\n[accept]\nrisk = 0.05  # of each limit: that a value which passes is beyond it, and one that fails "
        "within\n\n[limits]\n";
    for (const QuantityInfo& q : quantities())
        text += fmt::format("# \"{}\" = {{ min = , max = }}  # {}\n", q.name, q.words);
    return text;
}

}  // namespace zlg::acceptance
