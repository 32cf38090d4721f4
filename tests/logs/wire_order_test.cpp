#include <zlg/logs/wire_order.hpp>
#include <zlg/logs/wire_rows.hpp>

#include "line_gyro.hpp"

namespace zlg::logs::wire_order_test {

std::vector<Bytes> ticks_of(Gyro& gyro, int n) {
    std::vector<Bytes> frames;
    for (int k = 0; k < n; ++k) frames.push_back(gyro.tick());
    return frames;
}

struct Followed {
    std::vector<core::AngleRow> rows;
    WireSummary summary;
};

Followed followed(const std::vector<Bytes>& frames) {
    WireRows rows;
    for (const Bytes& frame : frames) rows.take(frame);
    rows.end();
    return {rows_of(rows), rows.summary()};
}

// The rows that were sent, of which those at the end that were not settled may lack their final values.
void expect_once(const std::vector<core::AngleRow>& got, const std::vector<core::AngleRow>& sent, const char* what) {
    ASSERT_EQ(got.size(), sent.size()) << what;
    for (std::size_t k = 0; k + delay_ticks < sent.size(); ++k) ASSERT_EQ(got[k], sent[k]) << what << ' ' << k;
    for (std::size_t k = 0; k < sent.size(); ++k) ASSERT_EQ(got[k].dtheta_arcsec, sent[k].dtheta_arcsec) << what;
}

TEST(WireOrder, AMessageIsHeldUntilAnotherOneContinuesIt) {
    const wire::Telemetry first{.tick = 7, .tick_s = 0.005};
    const wire::Telemetry second{.tick = 8, .tick_s = 0.005};
    WireOrder order;
    OrderedTelemetry ordered;
    order.put({.session = 3, .sequence = 10}, first);
    EXPECT_FALSE(order.next(ordered));
    EXPECT_FALSE(order.tick_s().has_value());
    order.put({.session = 3, .sequence = 11}, second);
    ASSERT_TRUE(order.next(ordered));
    EXPECT_EQ(ordered.telemetry, first);
    EXPECT_EQ(ordered.continuation, Continuation::next);
    EXPECT_FALSE(order.next(ordered));
    order.end();
    ASSERT_TRUE(order.next(ordered));
    EXPECT_EQ(ordered.telemetry, second);
}

// Rule 2 of docs/wire.md, also where the line has nothing else.
TEST(WireOrder, AtTheEndOfALineWhatNothingContinuesIsNotTaken) {
    for (const std::uint32_t apart : {0u, 1u, 100000u}) {
        WireOrder order;
        OrderedTelemetry ordered;
        order.put({.session = 3, .sequence = 10}, {.tick = 7, .tick_s = 0.005});
        if (apart > 0) order.put({.session = 3, .sequence = 10 + apart}, {.tick = 7 + apart, .tick_s = 0.005});
        order.end();
        int n = 0;
        while (order.next(ordered)) ++n;
        EXPECT_EQ(n, apart == 1 ? 2 : 0) << apart;
        EXPECT_EQ(order.summary().n_unfitting, apart == 0 ? 1u : apart == 1 ? 0u : 2u) << apart;
        EXPECT_EQ(order.tick_s().has_value(), apart == 1) << apart;
    }
}

TEST(WireOrder, AMessageThatComesAgainAnywhereIsTakenOnce) {
    for (const int at : {0, 1, 2, 5, 20, 100, 255, 256, 257, 1000, 1999})
        for (const int later : {0, 1, 2, 7, 190, 700}) {
            Gyro gyro;
            std::vector<Bytes> frames = ticks_of(gyro, 2000);
            frames.insert(frames.begin() + std::min(at + later + 1, 2000), Bytes{frames[static_cast<std::size_t>(at)]});
            const Followed f = followed(frames);
            expect_once(f.rows, gyro.rows, "again");
            EXPECT_EQ(f.summary.n_restarts, 0u) << at << ' ' << later;
            EXPECT_EQ(f.summary.n_repeated, 1u) << at << ' ' << later;
            EXPECT_EQ(f.summary.n_lost_rows, 0u);
        }
}

TEST(WireOrder, AReplayOfAnyLengthIsTakenOnce) {
    Gyro gyro;
    const std::vector<Bytes> sent = ticks_of(gyro, 3000);
    for (const auto& [from, to, then] : {std::array{0, 10, 200},
                                         {0, 300, 300},
                                         {0, 2500, 2500},
                                         {1500, 2900, 2950},
                                         {100, 101, 3000},
                                         {0, 3000, 3000},
                                         {1100, 1500, 1500}}) {
        std::vector<Bytes> frames{sent.begin(), sent.begin() + then};
        frames.insert(frames.end(), sent.begin() + from, sent.begin() + to);
        frames.insert(frames.end(), sent.begin() + then, sent.end());
        const Followed f = followed(frames);
        expect_once(f.rows, gyro.rows, "replay");
        EXPECT_EQ(f.summary.n_restarts, 0u) << from << ' ' << to;
        EXPECT_EQ(f.summary.n_repeated, static_cast<std::uint64_t>(to - from));
    }
}

TEST(WireOrder, OfAGyroThatCountsNoStartsOtherMessagesOfTheSameNumbersAreAStart) {
    for (const int joined : {0, 500, 1500}) {
        Gyro first{1};
        Gyro second{1, 0, 0, 60.0};
        std::vector<Bytes> frames = ticks_of(first, 2000);
        frames.erase(frames.begin(), frames.begin() + joined);
        const std::vector<Bytes> again = ticks_of(second, 100);
        frames.insert(frames.end(), again.begin(), again.end());
        // Both runs are then replayed; of the first one, what is remembered.
        const std::vector<Bytes> replayed{frames.begin(), frames.begin() + (joined < 1000 ? 50 : 0)};
        frames.insert(frames.end(), replayed.begin(), replayed.end());
        frames.insert(frames.end(), again.begin(), again.begin() + 90);
        const Followed f = followed(frames);
        EXPECT_EQ(f.summary.n_restarts, 1u) << joined;
        EXPECT_EQ(f.rows.size(), 2100u - static_cast<std::size_t>(joined > 0 ? joined - delay_ticks : 0)) << joined;
    }
}

// One whole frame of somebody else, anywhere: the log is what it is without it.
TEST(WireOrder, OneMessageThatIsNotTheGyrosSpoilsNothing) {
    const auto of_another = [](auto change) {
        wire::Sender sender{.session = 1, .sequence = 700};
        wire::Telemetry t{.tick = 700, .dtheta_arcsec = 1e6, .angle = 12345, .tick_s = 0.005};
        change(sender, t);
        const wire::Frame frame = frame_of(sender, t);
        return Bytes{frame.view().begin(), frame.view().end()};
    };
    using wire::Sender;
    using wire::Telemetry;
    const std::vector<Bytes> others{
        of_another([](Sender& s, Telemetry&) { s.session = 9; }),
        of_another([](Sender& s, Telemetry& t) { s.session = 9, s.sequence = 0, t.tick = 0; }),
        of_another([](Sender&, Telemetry& t) { t.tick_s = 0.01; }),
        of_another([](Sender& s, Telemetry& t) { s.sequence = 0x7FFFFFFF, t.tick = 0x7FFFFFFF; }),
        of_another([](Sender& s, Telemetry& t) { s.sequence = 60'000, t.tick = 60'000; }),
        of_another([](Sender& s, Telemetry& t) { s.sequence = 1u << 24, t.tick = 1u << 24; }),
        of_another([](Sender& s, Telemetry& t) { s.sequence = 2000, t.tick = (1u << 24) - 10; }),
        of_another([](Sender& s, Telemetry& t) { s.sequence = 2000, t.tick = 0; }),
        of_another([](Sender& s, Telemetry& t) { s.sequence = 1, t.tick = 1; })};
    for (std::size_t which = 0; which < others.size(); ++which)
        for (const int at : {0, 1, 100, 500, 1000}) {
            Gyro gyro;
            std::vector<Bytes> frames = ticks_of(gyro, 1100);
            frames.insert(frames.begin() + at, others[which]);
            const Followed f = followed(frames);
            ASSERT_EQ(f.rows.size(), 1100u) << which << ' ' << at;
            expect_once(f.rows, gyro.rows, "of another");
            EXPECT_EQ(f.summary.n_restarts + f.summary.n_outages + f.summary.n_lost_rows, 0u) << which << ' ' << at;
            // Of the first two it cannot be said which is the gyro's; no tick is lost by it.
            EXPECT_EQ(f.summary.n_unfitting + f.summary.n_repeated, at == 1 && which != 4 && which != 8 ? 2u : 1u)
                << which << ' ' << at;
        }
}

TEST(WireOrder, AGyroThatStartsAgainWithAnotherTickIsNotTaken) {
    Gyro first{1};
    Gyro second{2};
    second.tick_s = 0.01;
    Gyro third{3, 0, 0, 60.0};
    std::vector<Bytes> frames = ticks_of(first, 100);
    for (Gyro* const later : {&second, &third}) {
        const std::vector<Bytes> more = ticks_of(*later, 100);
        frames.insert(frames.end(), more.begin(), more.end());
    }
    const Followed f = followed(frames);
    EXPECT_EQ(f.rows.size(), 200u);
    EXPECT_EQ(f.summary.n_other_tick, 100u);
    EXPECT_EQ(f.summary.other_tick_s, 0.01);
    EXPECT_EQ(f.summary.n_restarts, 1u);
}

TEST(WireOrder, JumpsOfTheTicksMakeNoRows) {
    // Each message is 2^24 ticks after the one before, and fits nothing.
    Gyro gyro;
    std::vector<Bytes> frames = ticks_of(gyro, 20);
    wire::Sender sender{.session = 1, .sequence = 20};
    wire::Telemetry t{.tick = 20, .tick_s = 0.005};
    for (int k = 0; k < 200; ++k) {
        t.tick += (1u << 24) - 10;
        const wire::Frame frame = frame_of(sender, t);
        frames.push_back({frame.view().begin(), frame.view().end()});
    }
    const Followed f = followed(frames);
    EXPECT_EQ(f.rows.size(), 20u);
    EXPECT_EQ(f.summary.n_unfitting, 200u);
}

TEST(WireOrder, OneMessageBringsABoundedNumberOfRows) {
    Gyro gyro;
    WireRows rows;
    for (const Bytes& frame : ticks_of(gyro, 20)) rows.take(frame);
    (void)rows_of(rows);
    wire::Sender sender{.session = 1, .sequence = 20};
    wire::Telemetry t{.tick = 20, .tick_s = 0.005};
    for (int k = 0; k < 10; ++k) {
        t.tick += static_cast<std::uint32_t>(max_lost_rows);
        rows.take(frame_of(sender, t).view());
        EXPECT_LE(rows_of(rows).size(), static_cast<std::size_t>(2 * max_lost_rows));
    }
}

TEST(WireOrder, TheTurnOfAnOutageThatIsTooLongIsKnown) {
    // The same gyro, much later: its numbers have gone on. It turns by 0.25 arcsec a tick all the time.
    WireRows rows;
    wire::Sender sender{.session = 1};
    wire::TelemetryState state;
    const auto tick = [&](std::int64_t k, bool arrives) {
        core::AngleSample sample{.tick = k, .dtheta_arcsec = 0.25};
        sample.has_final = k >= delay_ticks;
        sample.final_row = {.tick = k - delay_ticks, .dtheta_arcsec = 0.25, .dtheta_final_arcsec = 0.25, .mode = 1};
        const wire::Frame frame = frame_of(sender, telemetry_of(state, sample, {.tick_s = 0.005}));
        if (arrives) rows.take(frame.view());
    };
    constexpr std::int64_t end = 100 + max_lost_rows + 1000;
    for (std::int64_t k = 0; k < end + 100; ++k) tick(k, k < 100 || k >= end);
    rows.end();
    const auto got = rows_of(rows);
    // From the tick on that is settled with the first message after it.
    ASSERT_EQ(got.size(), 200u + delay_ticks);
    EXPECT_EQ(rows.summary().n_outages, 1u);
    EXPECT_EQ(rows.summary().n_restarts, 0u);
    EXPECT_EQ(rows.summary().n_outage_ticks, static_cast<std::uint64_t>(end - 100 - delay_ticks));
    EXPECT_NEAR(rows.summary().outage_arcsec, 0.25 * static_cast<double>(end - 100 - delay_ticks), 1e-6);
    EXPECT_NEAR(rows.summary().angle_arcsec + rows.summary().outage_arcsec, 0.25 * static_cast<double>(end + 100),
                1e-6);
    EXPECT_EQ(rows.summary().n_lost_messages, static_cast<std::uint64_t>(end - 100));
    for (std::size_t k = 0; k < got.size(); ++k) EXPECT_EQ((got[k].flags & flag_outage) != 0, k == 100) << k;
}

TEST(WireOrder, TicksThatAreNeverSettledDoNotWaitForTheEnd) {
    WireRows rows;
    wire::Sender sender{.session = 1};
    wire::TelemetryState state;
    for (std::int64_t k = 0; k < 500; ++k) {
        const core::AngleSample sample{.tick = k, .dtheta_arcsec = std::sin(0.1 * static_cast<double>(k))};
        rows.take(frame_of(sender, telemetry_of(state, sample, {.tick_s = 0.005})).view());
    }
    const auto got = rows_of(rows);
    EXPECT_EQ(got.size(), 499u - wire::max_settled_age_ticks);
    for (std::size_t k = 0; k < got.size(); ++k) {
        EXPECT_EQ(got[k].dtheta_arcsec, std::sin(0.1 * static_cast<double>(k)));
        EXPECT_EQ(got[k].dtheta_final_arcsec, got[k].dtheta_arcsec);
        EXPECT_EQ(got[k].flags, flag_final_lost);
    }
    rows.end();
    EXPECT_EQ(rows_of(rows).size(), 500u - got.size());
}

// Repetitions, swaps, replays and true starts at random: each tick of each run is in the log once.
TEST(WireOrder, WhateverComesAgainEachTickIsInTheLogOnce) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        std::mt19937_64 random{seed};
        std::vector<Bytes> sent;
        std::vector<Bytes> arriving;
        std::size_t n_ticks = 0;
        double angle_arcsec = 0.0;
        const auto n_sessions = static_cast<std::uint16_t>(1 + random() % 3);
        for (std::uint16_t session = 1; session <= n_sessions; ++session) {
            Gyro gyro{session, 0, 0, 50.0 + session};
            const std::size_t begin = sent.size();
            const auto n = static_cast<int>(5 + random() % 1500);
            for (const Bytes& frame : ticks_of(gyro, n)) {
                sent.push_back(frame);
                arriving.push_back(frame);
                if (random() % 50 == 0) arriving.push_back(sent[random() % sent.size()]);
                if (random() % 300 == 0)
                    for (std::size_t from = random() % sent.size(), k = 0; k < 600 && from + k < sent.size(); ++k)
                        arriving.push_back(sent[from + k]);
                if (random() % 50 == 0 && sent.size() > begin + 3 && arriving.back() == frame &&
                    arriving[arriving.size() - 2] == sent[sent.size() - 2])
                    std::swap(arriving.back(), arriving[arriving.size() - 2]);
            }
            n_ticks += gyro.rows.size();
            angle_arcsec += sum(gyro.rows, &core::AngleRow::dtheta_arcsec);
        }
        const Followed f = followed(arriving);
        EXPECT_EQ(f.rows.size(), n_ticks) << seed;
        EXPECT_EQ(f.summary.n_restarts, n_sessions - 1u) << seed;
        EXPECT_NEAR(f.summary.angle_arcsec, angle_arcsec, 1e-6) << seed;
    }
}

}  // namespace zlg::logs::wire_order_test
