#pragma once
// Which requests for the page or its records are answered.

#include <cstdint>
#include <string_view>

namespace zlg::live {

// Of a request, as far as it decides; empty: the field is not there.
struct PageRequest {
    std::string_view method;
    std::string_view target;
    std::string_view host;
    std::string_view origin;
    std::string_view fetch_site;  // Sec-Fetch-Site
    int n_hosts = 1;              // fields of that name
    bool has_body = false;
};

enum class Reply { page, records, bad_request, not_found, not_allowed };

// Only GET of `/` and `/records`, by a name of this machine and from no page but our own: another site whose name was
// made to lead here (DNS rebinding) has its own name in Host, and one that merely points here has it in Origin.
//
// port  at which the server listens.
[[nodiscard]] Reply reply_to(const PageRequest& request, std::uint16_t port);

}  // namespace zlg::live
