#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <zlg/live/page_server.hpp>
#include <zlg/logs/error.hpp>

#include "test.hpp"

namespace zlg::live::page_server_test {

// One connection to a port of this machine.
class Peer {
public:
    explicit Peer(std::uint16_t port) : fd_{::socket(AF_INET, SOCK_STREAM, 0)} {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(port);
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        const timeval patience{.tv_sec = 10, .tv_usec = 0};
        ::setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        is_open = ::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    }
    ~Peer() { ::close(fd_); }
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;

    void say(const std::string& text) const { (void)::send(fd_, text.data(), text.size(), MSG_NOSIGNAL); }

    // All up to the end of the connection, or up to `mark`.
    std::string hear(const std::string& mark = {}) const {
        std::string heard;
        char piece[4096];
        while (mark.empty() || heard.find(mark) == std::string::npos) {
            const ssize_t n = ::recv(fd_, piece, sizeof piece, 0);
            if (n < 0 && errno == EINTR) continue;
            if (n <= 0) break;
            heard.append(piece, static_cast<std::size_t>(n));
        }
        return heard;
    }

    bool is_open = false;

private:
    int fd_;
};

std::string request(const PageServer& server, const std::string& target) {
    return "GET " + target + " HTTP/1.1\r\nHost: localhost:" + std::to_string(server.port()) + "\r\n\r\n";
}

TEST(PageServers, GiveThePageAndTheStream) {
    RecordBook book{"here", false};
    book.add({}, 0.005);
    const PageServer server{"<p>the page", book, 0};
    const Peer page{server.port()};
    page.say(request(server, "/"));
    const std::string answer = page.hear();
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 OK\r\n"));
    EXPECT_TRUE(answer.ends_with("\r\n\r\n<p>the page"));
    const Peer stream{server.port()};
    stream.say(request(server, "/records"));
    test::expect_contains(stream.hear("\n\nevent: snapshot\n"), "text/event-stream");
    book.add({.angle = {.tick = 1}}, 0.005);
    test::expect_contains(stream.hear("event: rows\n"), "event: rows");
}

TEST(PageServers, SayWhichPortIsInUse) {
    const RecordBook book{"", false};
    const PageServer server{"", book, 0};
    test::expect_contains(test::message_of<logs::IoError>([&] {
                              const PageServer second{"", book, server.port()};
                          }),
                          std::to_string(server.port()));
}

TEST(PageServers, EndAtOnceWithConnectionsOfEveryKindOpen) {
    RecordBook book{"", false};
    book.add({}, 0.005);
    // The least of three: other programs may want the processor.
    auto least = std::chrono::steady_clock::duration::max();
    for (int k = 0; k < 3; ++k) {
        auto server = std::make_unique<PageServer>("page", book, std::uint16_t{0});
        const Peer silent{server->port()};
        const Peer stream{server->port()};
        stream.say(request(*server, "/records"));
        stream.hear("snapshot");
        const std::uint16_t port = server->port();
        const auto begun = std::chrono::steady_clock::now();
        server.reset();
        least = std::min(least, std::chrono::steady_clock::now() - begun);
        EXPECT_FALSE(Peer{port}.is_open);
        // The port is free again.
        const PageServer second{"page", book, port};
        EXPECT_EQ(second.port(), port);
    }
    EXPECT_LT(least, std::chrono::milliseconds{300});
}

TEST(PageServers, TakeRecordsWhilePagesComeAndGo) {
    RecordBook book{"", false};
    const PageServer server{"page", book, 0};
    std::thread writer{[&book] {
        for (std::int64_t tick = 0; tick < 200'000; ++tick) book.add({.angle = {.tick = tick}}, 0.005);
        book.end();
    }};
    for (int k = 0; k < 20; ++k) {
        const Peer stream{server.port()};
        stream.say(request(server, "/records"));
        test::expect_contains(stream.hear("snapshot"), "snapshot");
    }
    writer.join();
    const Peer stream{server.port()};
    stream.say(request(server, "/records"));
    test::expect_contains(stream.hear("\"ended\":true"), "\"ended\":true");
}

}  // namespace zlg::live::page_server_test
