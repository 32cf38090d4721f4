#pragma once
// The page and its stream of records, over HTTP to this machine alone.

#include <cstdint>
#include <memory>
#include <string>

#include <zlg/live/record_book.hpp>

namespace zlg::live {

// Listens at 127.0.0.1 from a thread of its own: `/` is the page, `/records` the events of the book, ten times a
// second. What is asked otherwise is refused (page_request.hpp), and so is what lasts too long or is too large.
//
// A page that takes its events slowly is sent the next when it has taken the one before; after a minute without
// progress its connection ends.
class PageServer {
public:
    static constexpr int most_pages = 32;  // streams at a time; another gets status 503
    static constexpr int most_connections = 64;

    // page  HTML. book  outlives the server.
    // port  0: any that is free.
    //
    // errors  logs::IoError: the port is in use, or may not be used.
    PageServer(std::string page, const RecordBook& book, std::uint16_t port);

    // Ends all connections at once.
    ~PageServer();
    PageServer(const PageServer&) = delete;
    PageServer& operator=(const PageServer&) = delete;

    [[nodiscard]] std::uint16_t port() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace zlg::live
