#include <zlg/live/page_server.hpp>

#include <array>
#include <chrono>
#include <exception>
#include <map>
#include <set>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <boost/asio.hpp>
#include <boost/beast/core/flat_buffer.hpp>

#include <zlg/logs/error.hpp>

#include "http.hpp"

namespace zlg::live {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;
using Text = std::shared_ptr<const std::string>;

constexpr std::chrono::milliseconds event_every{100};
constexpr std::chrono::seconds request_within{5};
constexpr std::chrono::seconds page_within{30};
constexpr std::chrono::seconds event_within{60};
constexpr std::chrono::seconds parting_within{1};
constexpr int ticks_of_silence = 50;  // of event_every; then an empty line keeps the connection open
constexpr int stream_buffer_bytes = 1 << 18;

// One connection: a request, and its reply or the stream. All in the server's thread; it lives while an operation of it
// is under way.
class Connection : public std::enable_shared_from_this<Connection> {
public:
    // What the server decides.
    class Owner {
    public:
        virtual ~Owner() = default;
        virtual Text reply(Reply reply) = 0;
        virtual bool begin_stream(const std::shared_ptr<Connection>& page) = 0;  // false: there are too many
        [[nodiscard]] virtual std::uint16_t port() const = 0;
        virtual void left(const std::shared_ptr<Connection>& connection) = 0;
    };

    Connection(tcp::socket socket, Owner& owner)
        : socket_{std::move(socket)}, deadline_{socket_.get_executor()}, owner_{owner} {
        limit(parser_);
    }

    void start() {
        end_within(request_within);
        http::async_read_header(socket_, buffer_, parser_,
                                [self = shared_from_this()](error_code error, std::size_t) { self->answer(error); });
    }

    // The next event, or that of an earlier time again. Not while one is under way.
    void send(const Text& text, Position after) {
        position_ = after;
        is_busy_ = true;
        n_silent_ = 0;
        end_within(event_within);
        write(text, [](Connection& page) {
            page.is_busy_ = false;
            page.deadline_.cancel();
        });
    }

    // Once each tick of the server.
    [[nodiscard]] bool is_ready() const { return !is_busy_; }
    [[nodiscard]] bool is_silent() { return ++n_silent_ >= ticks_of_silence; }
    [[nodiscard]] Position position() const { return position_; }

private:
    void answer(error_code error) {
        const bool is_malformed = error.category() == http::make_error_code(http::error::bad_method).category();
        if (error && !is_malformed) return leave();
        const Reply reply = error ? Reply::bad_request : reply_to(parser_, owner_.port());
        if (reply == Reply::records && owner_.begin_stream(shared_from_this())) return stream();
        end_within(reply == Reply::page ? page_within : request_within);
        // A stream that is not begun is one too many.
        const Text text = reply == Reply::records
                              ? std::make_shared<const std::string>(error_reply(http::status::service_unavailable))
                              : owner_.reply(reply);
        write(text, [](Connection& connection) { connection.part(); });
    }

    void stream() {
        error_code ignored;
        socket_.set_option(asio::socket_base::send_buffer_size{stream_buffer_bytes}, ignored);
        send(std::make_shared<const std::string>(stream_head()), {});
        // A page that streams says nothing more, until it goes.
        read([](Connection& page, bool) { page.leave(); });
    }

    // What was asked is read to its end, within limits, or the system would throw away the reply.
    void part() {
        error_code ignored;
        socket_.shutdown(tcp::socket::shutdown_send, ignored);
        end_within(parting_within);
        read_on();
    }
    void read_on() {
        read([](Connection& connection, bool is_open) {
            if (is_open) return connection.read_on();
            connection.leave();
        });
    }

    template <class Then> void read(const Then& then) {
        socket_.async_read_some(asio::buffer(unwanted_), [self = shared_from_this(), then](
                                                             error_code error, std::size_t) { then(*self, !error); });
    }

    template <class Then> void write(const Text& text, const Then& then) {
        asio::async_write(socket_, asio::buffer(*text),
                          [self = shared_from_this(), text, then](error_code error, std::size_t) {
                              if (error) return self->leave();
                              then(*self);
                          });
    }

    void end_within(std::chrono::seconds time) {
        deadline_.expires_after(time);
        deadline_.async_wait([self = shared_from_this()](error_code error) {
            // One that has been set anew since is another.
            if (!error && self->deadline_.expiry() <= std::chrono::steady_clock::now()) self->leave();
        });
    }

    void leave() {
        error_code ignored;
        deadline_.cancel();
        socket_.close(ignored);
        owner_.left(shared_from_this());
    }

    tcp::socket socket_;
    asio::steady_timer deadline_;
    Owner& owner_;
    boost::beast::flat_buffer buffer_{most_header_bytes + 1024};
    RequestParser parser_;
    std::array<char, 4096> unwanted_{};
    Position position_;
    bool is_busy_ = false;
    int n_silent_ = 0;
};

[[noreturn]] void refuse(std::uint16_t port, const error_code& error) {
    if (error == asio::error::address_in_use)
        throw logs::IoError{
            fmt::format("port {} of 127.0.0.1 is in use; --port names another, 0 any that is free", port)};
    throw logs::IoError{fmt::format("port {} of 127.0.0.1: {}", port, error.message())};
}

}  // namespace

struct PageServer::State final : Connection::Owner {
    State(std::string html, const RecordBook& records, std::uint16_t wanted_port)
        : page{std::make_shared<const std::string>(page_reply(html))}, book{records} {
        listen(wanted_port);
        accept();
        wait();
    }

    void listen(std::uint16_t wanted_port) {
        const tcp::endpoint here{asio::ip::address_v4::loopback(), wanted_port};
        error_code error;
        acceptor.open(here.protocol(), error);
        if (!error) acceptor.set_option(tcp::acceptor::reuse_address{true}, error);
        if (!error) acceptor.bind(here, error);
        if (!error) acceptor.listen(most_connections, error);
        if (error) refuse(wanted_port, error);
        bound_port = acceptor.local_endpoint().port();
    }

    void accept() {
        acceptor.async_accept([this](error_code error, tcp::socket socket) {
            // Where there are no descriptors left, or no memory, the next tick tries again.
            is_accepting = false;
            if (error) return;
            // Without room for one more it is closed at once.
            if (connections.size() < static_cast<std::size_t>(most_connections)) {
                const auto connection = std::make_shared<Connection>(std::move(socket), *this);
                connections.insert(connection);
                connection->start();
            }
            accept();
        });
        is_accepting = true;
    }

    void wait() {
        timer.expires_after(event_every);
        timer.async_wait([this](error_code error) {
            if (error) return;
            wait();
            if (!is_accepting) accept();
            send_events();
        });
    }

    // Pages that have got equally far are sent the same text.
    void send_events() {
        const Position newest = book.position();
        std::map<std::int64_t, std::pair<Position, Text>> made;
        for (const auto& connection : pages) {
            if (!connection->is_ready()) continue;
            const Position from = connection->position();
            if (from == newest) {
                if (connection->is_silent()) connection->send(silence, from);
                continue;
            }
            auto& [after, text] = made[from.next_row];
            if (!text) {
                Event event = book.event(from);
                after = event.after;
                text = std::make_shared<const std::string>(std::move(event.text));
            }
            connection->send(text, after);
        }
    }

    Text reply(Reply what) override {
        return what == Reply::page ? page : std::make_shared<const std::string>(error_reply(status_of(what)));
    }
    bool begin_stream(const std::shared_ptr<Connection>& connection) override {
        return pages.size() < static_cast<std::size_t>(most_pages) && pages.insert(connection).second;
    }
    [[nodiscard]] std::uint16_t port() const override { return bound_port; }
    void left(const std::shared_ptr<Connection>& connection) override {
        pages.erase(connection);
        connections.erase(connection);
    }

    // What goes wrong with one connection, for want of memory for example, ends no other.
    void run() {
        while (!io.stopped()) {
            try {
                io.run();
            } catch (const std::exception&) {
            }
        }
    }

    Text page;
    const RecordBook& book;
    const Text silence = std::make_shared<const std::string>(":\n\n");
    asio::io_context io{1};
    tcp::acceptor acceptor{io};
    std::uint16_t bound_port = 0;
    asio::steady_timer timer{io};
    bool is_accepting = false;
    std::set<std::shared_ptr<Connection>> connections;
    std::set<std::shared_ptr<Connection>> pages;  // of them
    std::thread thread;
};

PageServer::PageServer(std::string page, const RecordBook& book, std::uint16_t port)
    : state_{std::make_unique<State>(std::move(page), book, port)} {
    state_->thread = std::thread{[state = state_.get()] { state->run(); }};
}

PageServer::~PageServer() {
    state_->io.stop();
    state_->thread.join();
}

std::uint16_t PageServer::port() const { return state_->port(); }

}  // namespace zlg::live
