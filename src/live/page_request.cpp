#include <zlg/live/page_request.hpp>

#include <fmt/format.h>

namespace zlg::live {
namespace {

bool is_ours(std::string_view host, std::uint16_t port) {
    return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port) ||
           (port == 80 && (host == "127.0.0.1" || host == "localhost"));
}

bool comes_from_elsewhere(const PageRequest& request) {
    const bool other_site = !request.fetch_site.empty() && request.fetch_site != "same-origin" &&
                            request.fetch_site != "none" && request.target != "/";
    const bool other_origin = !request.origin.empty() && request.origin != fmt::format("http://{}", request.host);
    return other_site || other_origin;
}

}  // namespace

Reply reply_to(const PageRequest& request, std::uint16_t port) {
    if (request.n_hosts != 1 || !is_ours(request.host, port) || request.has_body || comes_from_elsewhere(request))
        return Reply::bad_request;
    const bool is_page = request.target == "/";
    if (!is_page && request.target != "/records") return Reply::not_found;
    if (request.method != "GET") return Reply::not_allowed;
    return is_page ? Reply::page : Reply::records;
}

}  // namespace zlg::live
