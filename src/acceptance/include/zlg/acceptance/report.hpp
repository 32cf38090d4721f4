#pragma once
// The record of an acceptance test, and the page that shows it: for people, with the record in it and a checksum under
// all.

#include <string>
#include <vector>

#include <zlg/acceptance/accept.hpp>
#include <zlg/report/page.hpp>

namespace zlg::acceptance {

// As one JSON object. The same inputs give the same bytes: there is neither a clock nor a name of an output in it.
[[nodiscard]] std::string record_json(const Acceptance& test, const std::string& command);

// earlier  records of other tests, as read_report gives them: drawn as a trend where they are of the unit's type.
[[nodiscard]] report::Page acceptance_page(const Acceptance& test, const std::string& command,
                                           const std::vector<std::string>& earlier = {});

// The page as a file.
[[nodiscard]] std::string report_html(const report::Page& page);

// The record in a page.
//
// errors  logs::IoError: it cannot be read; logs::FormatError: it holds no record, or its bytes are not those that were
// written.
[[nodiscard]] std::string read_report(const std::string& path);

// Those of a folder, in the order of their names; other files are passed over.
//
// errors  logs::IoError: no such folder; logs::FormatError: as read_report, of a page that holds a record.
[[nodiscard]] std::vector<std::string> read_reports(const std::string& folder);

struct Verification {
    bool fits = true;
    std::vector<std::string> lines;  // what was held against what
};

// Page and logs against the record. It finds damage, not forgery: who can write a page can write its checksum.
//
// errors  as read_report; logs::IoError for a log.
[[nodiscard]] Verification verify(const std::string& report, const std::vector<std::string>& logs);

}  // namespace zlg::acceptance
