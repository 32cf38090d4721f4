#include "http.hpp"

#include <fmt/format.h>

namespace zlg::live {
namespace {

// Nothing is to be kept, read by another site, or taken for what it is not.
constexpr std::string_view careful =
    "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\nX-Frame-Options: DENY\r\nConnection: close\r\n";

std::string head(http::status status, std::string_view type) {
    const auto reason = http::obsolete_reason(status);
    return fmt::format("HTTP/1.1 {} {}\r\nContent-Type: {}; charset=utf-8\r\n{}", static_cast<unsigned>(status),
                       std::string_view{reason.data(), reason.size()}, type, careful);
}

std::string whole(http::status status, std::string_view type, std::string_view more, std::string_view body) {
    return fmt::format("{}{}Content-Length: {}\r\n\r\n{}", head(status, type), more, body.size(), body);
}

}  // namespace

http::status status_of(Reply reply) {
    switch (reply) {
        case Reply::page:
        case Reply::records: return http::status::ok;
        case Reply::not_found: return http::status::not_found;
        case Reply::not_allowed: return http::status::method_not_allowed;
        case Reply::bad_request: break;
    }
    return http::status::bad_request;
}

std::string error_reply(http::status status) {
    const auto reason = http::obsolete_reason(status);
    return whole(status, "text/plain", status == http::status::method_not_allowed ? "Allow: GET\r\n" : "",
                 fmt::format("{}\n", std::string_view{reason.data(), reason.size()}));
}

std::string page_reply(const std::string& page) {
    return whole(http::status::ok, "text/html", "Content-Security-Policy: frame-ancestors 'none'\r\n", page);
}

std::string stream_head() { return head(http::status::ok, "text/event-stream") + "\r\nretry: 500\n\n"; }

}  // namespace zlg::live
