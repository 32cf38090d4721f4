// Frames of telemetry through damage of seven kinds: everything that comes out is compared with what was sent.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <zlg/chance/draw.hpp>
#include <zlg/wire/telemetry.hpp>

#include "command.hpp"

namespace {

using namespace zlg;
using Bytes = std::vector<std::uint8_t>;
using chance::Draw;

std::uint8_t any_byte(Draw& draw) { return static_cast<std::uint8_t>(draw.bits()); }

std::size_t place(Draw& draw, const Bytes& frame) { return draw.below(frame.size()); }

void flip_bits(Draw& draw, Bytes& frame, int n) {
    for (int k = 0; k < n; ++k) {
        std::uint8_t& byte = frame[place(draw, frame)];
        byte = static_cast<std::uint8_t>(byte ^ (1u << (draw.below(8))));
    }
}

void burst(Draw& draw, Bytes& frame) {
    const std::size_t from = place(draw, frame);
    for (std::size_t k = from; k < frame.size() && k < from + 1 + draw.below(32); ++k) frame[k] = any_byte(draw);
}

void lose(Draw& draw, Bytes& frame) {
    const std::size_t from = place(draw, frame);
    const std::size_t n = std::min<std::size_t>(1 + draw.below(16), frame.size() - from);
    frame.erase(frame.begin() + static_cast<std::ptrdiff_t>(from),
                frame.begin() + static_cast<std::ptrdiff_t>(from + n));
}

void insert(Draw& draw, Bytes& frame) {
    frame.insert(frame.begin() + static_cast<std::ptrdiff_t>(place(draw, frame)), any_byte(draw));
}

// Noise with the zeros of a frame and of its length, which asks the CRC alone.
void noise(Draw& draw, Bytes& frame) {
    for (std::size_t k = 1; k + 1 < frame.size(); ++k) frame[k] = static_cast<std::uint8_t>(1 + draw.below(255));
    frame[1] = static_cast<std::uint8_t>(frame.size() - 2);
}

struct Kind {
    const char* name;
    void (*damage)(Draw&, Bytes&);
};

constexpr Kind kinds[]{
    {"one bit", [](Draw& r, Bytes& f) { flip_bits(r, f, 1); }},
    {"2 to 5 bits", [](Draw& r, Bytes& f) { flip_bits(r, f, 2 + static_cast<int>(r.below(4))); }},
    {"6 to 60 bits", [](Draw& r, Bytes& f) { flip_bits(r, f, 6 + static_cast<int>(r.below(55))); }},
    {"a burst of up to 32 bytes", burst},
    {"1 to 16 bytes lost", lose},
    {"a byte inserted", insert},
    {"noise of a frame's length", noise},
};

wire::Telemetry telemetry(Draw& draw, std::uint32_t tick) {
    wire::Telemetry t{.tick = tick, .has_settled = true, .settled_age_ticks = 20, .tick_s = 0.005};
    t.angle = draw.bits();
    t.settled_angle = draw.bits();
    t.settled_final_angle = draw.bits();
    t.dtheta_arcsec = static_cast<double>(draw.below(100000)) / 7.0;
    t.settled_dtheta_arcsec = t.dtheta_arcsec + 1.0;
    t.settled_final_arcsec = t.dtheta_arcsec + 1.5;
    t.time.timer_ticks = draw.bits();
    return t;
}

struct Tally {
    std::uint64_t n_sent = 0;      // damaged
    std::uint64_t n_unharmed = 0;  // came out as they were sent: the damage undid itself or hit a zero at an end
    std::uint64_t n_wrong = 0;     // came out otherwise
};

Tally campaign(const Kind& kind, std::uint64_t n) {
    Draw draw{1, chance::Cause::wire_damage};
    wire::Sender sender{.session = 1};
    wire::Receiver receiver;
    Tally tally;
    for (; tally.n_sent < n; ++tally.n_sent) {
        const wire::Telemetry sent = telemetry(draw, static_cast<std::uint32_t>(tally.n_sent));
        const wire::Frame frame = frame_of(sender, sent);
        Bytes bytes{frame.view().begin(), frame.view().end()};
        kind.damage(draw, bytes);
        bytes.push_back(0);
        std::span<const std::uint8_t> rest{bytes};
        wire::Message message;
        while (receive(receiver, rest, message)) {
            const bool same =
                message.session == 1 && message.sequence == sender.sequence - 1 && wire::telemetry_in(message) == sent;
            ++(same ? tally.n_unharmed : tally.n_wrong);
        }
    }
    return tally;
}

}  // namespace

int main(int argc, char** argv) {
    std::uint64_t n = 1'500'000;
    CLI::App app{"Frames of telemetry through damage of seven kinds", "zlg_wire_damage"};
    app.add_option("FRAMES", n, "damaged, of each kind")->check(CLI::PositiveNumber);
    return trials::run_command(app, argc, argv, [&] {
        std::uint64_t n_all = 0;
        std::uint64_t n_wrong = 0;
        fmt::print("| damage | frames | taken, unharmed | taken, wrong |\n|---|---|---|---|\n");
        for (const Kind& kind : kinds) {
            const Tally t = campaign(kind, n);
            fmt::print("| {} | {} | {} | {} |\n", kind.name, t.n_sent, t.n_unharmed, t.n_wrong);
            n_all += t.n_sent;
            n_wrong += t.n_wrong;
        }
        fmt::print("| all | {} | | {} |\n", n_all, n_wrong);
        return n_wrong == 0 ? 0 : 1;
    });
}
