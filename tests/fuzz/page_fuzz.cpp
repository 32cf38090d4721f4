// Any bytes as a request to the server of the lab page, in pieces: what is answered with more than a refusal was asked
// rightly. And any numbers as records: their events are events, and JSON.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include <boost/asio/buffer.hpp>
#include <nlohmann/json.hpp>

#include <zlg/live/record_book.hpp>

#include "http.hpp"

#include "bytes.hpp"
#include "claim.hpp"

namespace {

using namespace zlg;
using fuzz::Bytes;
using fuzz::claim;

constexpr std::uint16_t port = 8137;

// Up to the end of the header, or to an error. As in the server, what was not understood comes again with the next
// piece.
boost::system::error_code parse(live::RequestParser& parser, std::string_view text, std::size_t piece) {
    boost::system::error_code error;
    std::size_t begin = 0;
    for (std::size_t end = std::min(piece, text.size()); !parser.is_header_done();
         end = std::min(end + piece, text.size())) {
        begin += parser.put(boost::asio::buffer(text.substr(begin, end - begin).data(), end - begin), error);
        if (error && error != live::http::error::need_more) return error;
        if (end == text.size()) break;
    }
    return error;
}

void ask(std::string_view text, std::size_t piece) {
    live::RequestParser parser;
    live::limit(parser);
    const boost::system::error_code error = parse(parser, text, piece);
    if (error || !parser.is_header_done()) return;
    const live::Reply reply = live::reply_to(parser, port);
    if (reply != live::Reply::page && reply != live::Reply::records) return;
    claim(text.find("GET") != text.npos, "only GET is answered");
    claim(text.find("127.0.0.1:8137") != text.npos || text.find("localhost:8137") != text.npos, "only for our name");
    claim(parser.get().target() == (reply == live::Reply::page ? "/" : "/records"), "only what there is");
    claim(text.size() < live::most_header_bytes + piece, "within limits");
}

void tell(Bytes& bytes) {
    live::RecordBook book{std::string(bytes.take<std::uint8_t>() % 8, static_cast<char>(bytes.take<std::uint8_t>())),
                          bytes.flag()};
    const double tick_s = bytes.flag() ? 0.005 : 1e-4;
    live::Position page;
    while (!bytes.empty()) {
        live::Record record;
        record.angle = {.tick = bytes.take<std::int64_t>(),
                        .dtheta_arcsec = bytes.real(10.0),
                        .dtheta_final_arcsec = bytes.real(10.0),
                        .sigma_arcsec = bytes.real(1.0),
                        .mode = bytes.sign(),
                        .flags = bytes.take<std::uint32_t>()};
        record.piezo_v = bytes.real(100.0);
        record.health = bytes.take<std::uint32_t>();
        // What a source gives are finite angles.
        for (double* angle : {&record.angle.dtheta_arcsec, &record.angle.dtheta_final_arcsec})
            if (!std::isfinite(*angle)) *angle = 0.0;
        const int n = 1 + bytes.take<std::uint8_t>() % 4;
        for (int k = 0; k < n; ++k) book.add(record, tick_s);
        if (bytes.index(8) != 0) continue;
        const live::Event event = book.event(page);
        page = event.after;
        claim(std::ranges::count(event.text, '\n') == 3 && event.text.ends_with("\n\n"), "an event is two lines");
        const std::size_t data = event.text.find("\ndata: ");
        claim(nlohmann::json::accept(event.text.substr(data + 7)), "its data are JSON");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    if (data[0] == '!') {
        Bytes bytes{data + 1, size - 1};
        tell(bytes);
    } else {
        ask({reinterpret_cast<const char*>(data), size}, size);
        ask({reinterpret_cast<const char*>(data), size}, 1 + data[size - 1] % 64);
    }
    return 0;
}
