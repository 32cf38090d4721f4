#pragma once
// Which messages of a line are news, and in which order: what comes again or late is left out, what fits nothing is
// refused.
//
// No message counts alone: it is held until the next one continues it. So one message that is not the gyro's, however
// whole, neither begins anything nor ends it. The rules are those of docs/wire.md, "Order of the messages".

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include <zlg/wire/frame.hpp>
#include <zlg/wire/telemetry.hpp>

namespace zlg::logs {

// Messages, and ticks, that may be missing between two messages of one run: 5.5 minutes of ticks of 5 ms.
inline constexpr std::int64_t max_lost_rows = std::int64_t{1} << 16;

// How a message stands to the one before it.
enum class Continuation {
    next,     // nothing or something is lost between them, up to max_lost_rows
    restart,  // the gyro has started anew, or has begun to measure anew
    outage    // the same run of the gyro, after a longer loss
};

struct OrderedTelemetry {
    wire::Telemetry telemetry{};
    Continuation continuation = Continuation::next;
};

struct OrderSummary {
    std::uint64_t n_lost_messages = 0;  // by the sequence numbers
    std::uint64_t n_repeated = 0;       // messages that came again, or too late
    std::uint64_t n_unfitting = 0;      // that fit neither what came before them nor what came after
    std::uint64_t n_other_tick = 0;     // of a gyro whose tick has another length than that of the log
    double other_tick_s = 0.0;          // the last one of these lengths
};

class WireOrder {
public:
    // What is known by now waits in `next`.
    void put(const wire::Message& message, const wire::Telemetry& telemetry);

    // A status or a reply, which only has a number. False where it came before.
    bool put(const wire::Message& message);

    // Nothing more comes.
    void end();

    // The next message in order; false where none waits.
    bool next(OrderedTelemetry& ordered);

    [[nodiscard]] const OrderSummary& summary() const { return summary_; }
    // Length of the log's tick: that of the first message that another one continues; nothing before.
    [[nodiscard]] std::optional<double> tick_s() const { return tick_s_; }

private:
    struct Arrival {
        wire::Telemetry telemetry{};
        std::uint16_t session = 0;
        std::uint32_t sequence = 0;
        std::uint32_t check = 0;  // CRC of the body
    };
    // What is remembered of the messages from one start of the gyro to the next.
    struct Run {
        std::uint16_t session = 0;
        std::uint32_t first = 0;  // sequence numbers
        std::uint32_t last = 0;
        std::vector<std::uint64_t> head{};  // by sequence number: the check, and a bit that says that it is there
    };

    [[nodiscard]] static bool continues(const Arrival& before, const Arrival& after);
    [[nodiscard]] static bool may_have_sent(const Run& run, const Arrival& a);
    [[nodiscard]] bool is_known(const Arrival& a) const;
    [[nodiscard]] bool came_before(const Arrival& a) const;
    void put_between(const Arrival& a);
    void hold(const Arrival& a, bool fits);
    void refuse_held();
    void commit(const Arrival& a);
    [[nodiscard]] Continuation begin(const Arrival& a);
    void count_lost(const Arrival& a);
    void remember(const Arrival& a);

    std::optional<Arrival> last_{};  // that was taken
    std::optional<Arrival> held_{};
    bool held_fits_ = false;  // to the last one
    int n_between_ = 0;       // messages that fitted between the last one and that which is held
    std::deque<Run> runs_{};
    std::vector<std::pair<std::uint16_t, std::uint32_t>> others_{};  // session and sequence of status and replies
    std::deque<OrderedTelemetry> waiting_{};
    std::optional<double> tick_s_{};
    OrderSummary summary_{};
};

}  // namespace zlg::logs
