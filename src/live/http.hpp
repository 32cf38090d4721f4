#pragma once
// Requests and replies of the page's server, by Boost.Beast.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <boost/beast/http.hpp>

#include <zlg/live/page_request.hpp>

namespace zlg::live {

namespace http = boost::beast::http;

inline constexpr std::size_t most_header_bytes = 8192;

using RequestParser = http::request_parser<http::empty_body>;

// Takes requests within our limits.
inline void limit(RequestParser& parser) {
    parser.header_limit(most_header_bytes);
    parser.body_limit(0);
}

// Of the header of a request.
[[nodiscard]] inline Reply reply_to(const RequestParser& parser, std::uint16_t port) {
    const auto& request = parser.get();
    const auto view = [](boost::beast::string_view text) { return std::string_view{text.data(), text.size()}; };
    const boost::optional<std::uint64_t> length = parser.content_length();
    return reply_to({.method = view(request.method_string()),
                     .target = view(request.target()),
                     .host = view(request[http::field::host]),
                     .origin = view(request[http::field::origin]),
                     .fetch_site = view(request["Sec-Fetch-Site"]),
                     .n_hosts = static_cast<int>(request.count(http::field::host)),
                     .has_body = parser.chunked() || (length && *length > 0)},
                    port);
}

// A whole reply, after which the connection ends. What was asked is in none.
[[nodiscard]] std::string error_reply(http::status status);
[[nodiscard]] std::string page_reply(const std::string& page);

// The beginning of a stream of events.
[[nodiscard]] std::string stream_head();

[[nodiscard]] http::status status_of(Reply reply);

}  // namespace zlg::live
