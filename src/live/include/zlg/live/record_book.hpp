#pragma once
// What pages show of a gyro: its newest records, and in bounded memory what came before.
//
// One thread adds records, others ask for events: pieces of the stream of server-sent events (WHATWG HTML,
// section 9.2), each a name and one line of JSON. A page that is not far behind gets every record; one that is, or that
// is new, gets a snapshot, from which it goes on. Whoever asks holds the book while the records are copied and, once a
// second, while the Allan deviation is computed: some milliseconds, and no page can make it longer.

#include <cstdint>
#include <memory>
#include <string>

#include <zlg/live/record_source.hpp>

namespace zlg::live {

// How far a page has got.
struct Position {
    std::int64_t next_row = -1;  // -1: it has nothing
    bool knows_end = false;      // of the source

    friend bool operator==(const Position&, const Position&) = default;
};

struct Event {
    Position after;  // of the page that has it
    std::string text;
};

class RecordBook {
public:
    static constexpr std::int64_t kept_rows = 8192;  // in a snapshot
    static constexpr std::int64_t most_rows =
        2048;  // in an event that is none; a page that is further behind gets a snapshot

    // source  as it is named on the page, in any bytes.
    RecordBook(std::string source, bool tells_health);
    ~RecordBook();
    RecordBook(const RecordBook&) = delete;
    RecordBook& operator=(const RecordBook&) = delete;

    // tick_s  > 0, the same each time.
    void add(const Record& record, double tick_s);

    // Nothing more comes.
    void end();

    // Of a page that knows all.
    [[nodiscard]] Position position() const;

    // What brings a page to that place. `snapshot` or `rows`, with
    //
    //   both      tick_s (null before the first record), first (the number of the first row), rows, ended, since_start:
    //   {flags, health} (bits that
    //             were ever raised)
    //   rows      a list for each record: dtheta, dtheta_final, sigma, arcsec (null: not known); mode; flags; angle:
    //   the sum of dtheta_final up to
    //             and with it, arcsec; detuning, lambda; piezo voltage, V; temperature, C; bits of health
    //   gap       of the newest gap whose surroundings are complete, where the page does not have it: first (row),
    //   ticks, mode (after it), and
    //             lists of dtheta and dtheta_final (`final`) from the row `shown` on
    //   allan     now and then: averaging times, s, and the overlapping Allan deviation of dtheta_final there, arcsec/s
    //   snapshot  also source, flag_names, health_names (empty: the source tells none), and history: times, s, and
    //   angles, arcsec, of the whole
    //             record, thinned
    [[nodiscard]] Event event(Position from) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace zlg::live
