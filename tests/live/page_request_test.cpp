#include <zlg/live/page_request.hpp>

#include "test.hpp"

namespace zlg::live::page_request_test {

constexpr std::uint16_t port = 8137;

PageRequest good() { return {.method = "GET", .target = "/", .host = "127.0.0.1:8137"}; }

TEST(PageRequests, ForThePageAndForItsRecordsAreAnswered) {
    PageRequest request = good();
    EXPECT_EQ(reply_to(request, port), Reply::page);
    request.target = "/records";
    EXPECT_EQ(reply_to(request, port), Reply::records);
    request.host = "localhost:8137";
    request.origin = "http://localhost:8137";
    request.fetch_site = "same-origin";
    EXPECT_EQ(reply_to(request, port), Reply::records);
}

TEST(PageRequests, ForAnythingElseAreNot) {
    PageRequest request = good();
    for (const char* target :
         {"", "/x", "/records/", "/Records", "//", "/?", "/records?x", "*", "http://127.0.0.1:8137/"}) {
        request.target = target;
        EXPECT_EQ(reply_to(request, port), Reply::not_found) << target;
    }
    request = good();
    for (const char* method : {"POST", "HEAD", "get", "OPTIONS", ""}) {
        request.method = method;
        EXPECT_EQ(reply_to(request, port), Reply::not_allowed) << method;
    }
}

// DNS rebinding: the browser believes that it speaks with the site of that name.
TEST(PageRequests, ByAnotherNameAreRefused) {
    PageRequest request = good();
    for (const char* host : {"", "evil.example:8137", "127.0.0.1", "127.0.0.1:81370", "127.0.0.1:8137 ",
                             "127.0.0.1.evil:8137", "localhost", "127.0.0.2:8137", "[::1]:8137"}) {
        request.host = host;
        EXPECT_EQ(reply_to(request, port), Reply::bad_request) << host;
    }
    request = good();
    request.n_hosts = 2;
    EXPECT_EQ(reply_to(request, port), Reply::bad_request);
    request = good();
    request.host = "127.0.0.1";
    EXPECT_EQ(reply_to(request, 80), Reply::page);  // whose port is not named
}

TEST(PageRequests, FromAnotherPageGetNoRecords) {
    PageRequest request = good();
    request.target = "/records";
    for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1:8137", "http://localhost:8137"}) {
        request.origin = origin;
        EXPECT_EQ(reply_to(request, port), Reply::bad_request) << origin;
    }
    request.origin = "";
    for (const char* site : {"cross-site", "same-site", "x"}) {
        request.fetch_site = site;
        EXPECT_EQ(reply_to(request, port), Reply::bad_request) << site;
    }
    // A link that leads to the page is good.
    request.target = "/";
    request.fetch_site = "cross-site";
    EXPECT_EQ(reply_to(request, port), Reply::page);
}

TEST(PageRequests, WithABodyAreRefused) {
    PageRequest request = good();
    request.has_body = true;
    EXPECT_EQ(reply_to(request, port), Reply::bad_request);
}

}  // namespace zlg::live::page_request_test
