#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <zlg/logs/follower.hpp>
#include <zlg/study/fields.hpp>

#include "bind.hpp"
#include "log_columns.hpp"
#include "use.hpp"

namespace zlg::python {
namespace {

// A gyro's line in batches of rows.
class Line {
public:
    Line(const std::string& source, int baud, std::optional<double> duration_s)
        : follower_{without_interpreter([&] { return std::make_unique<logs::Follower>(source, baud, duration_s); })},
          duration_s_{duration_s} {}

    // Up to `most_rows`, or those of `patience_s` and one at least; none: the line has ended. What has come before an
    // exception, as of Ctrl-C, is in the next batch.
    py::object batch(std::int64_t most_rows, double patience_s) {
        const Use use{is_busy_, "line"};
        without_interpreter([&] { collect(most_rows, patience_s); });
        const auto rows = static_cast<std::int64_t>(batch_.size());
        if (rows == 0) return py::none();
        py::dict columns = std::exchange(batch_, {}).take_out();
        columns["first_tick"] = given_;
        columns["tick_s"] = *follower_->rows().tick_s();
        given_ += rows;
        return columns;
    }

    void stop() {
        const Use use{is_busy_, "line"};
        follower_->stop();
    }

    [[nodiscard]] py::dict summary() {
        const Use use{is_busy_, "line"};
        const logs::WireSummary& s = follower_->rows().summary();
        py::dict d("ticks"_a = follower_->n_rows(), "angle_arcsec"_a = follower_->angle_arcsec(),
                   "outage_arcsec"_a = s.outage_arcsec);
        for (const study::LineCount& count : study::line_counts) d[count.name] = s.*count.member;
        return d;
    }

private:
    using Clock = std::chrono::steady_clock;

    void collect(std::int64_t most_rows, double patience_s) {
        constexpr std::chrono::milliseconds look_every{50};
        const auto started = Clock::now();
        auto looked = started;
        core::AngleRow row;
        for (std::int64_t k = 0; static_cast<std::int64_t>(batch_.size()) < most_rows; ++k) {
            const logs::Follower::Next next = follower_->next(row);
            if (next == logs::Follower::Next::end) return;
            if (next == logs::Follower::Next::row) batch_.add(row);
            if (next == logs::Follower::Next::row && k % 1024 != 0) continue;
            const auto now = Clock::now();
            if (duration_s_ && std::chrono::duration<double>{now - begun_}.count() >= *duration_s_) follower_->stop();
            if (now - looked >= look_every) {
                look_for_signals();
                looked = now;
            }
            if (batch_.size() > 0 && std::chrono::duration<double>{now - started}.count() >= patience_s) return;
        }
    }

    std::unique_ptr<logs::Follower> follower_;
    std::optional<double> duration_s_;
    Clock::time_point begun_ = Clock::now();
    AngleCollector batch_;
    std::int64_t given_ = 0;
    bool is_busy_ = false;
};

}  // namespace

void bind_line(py::module_& m) {
    py::class_<Line>(m, "Line")
        .def(py::init<const std::string&, int, std::optional<double>>())
        .def("batch", &Line::batch)
        .def("stop", &Line::stop)
        .def("summary", &Line::summary);
    m.attr("default_baud") = logs::default_baud;
    m.attr("line_flags") = py::dict("lost"_a = static_cast<std::uint32_t>(logs::flag_lost),
                                    "final_lost"_a = static_cast<std::uint32_t>(logs::flag_final_lost),
                                    "restarted"_a = static_cast<std::uint32_t>(logs::flag_restarted),
                                    "outage"_a = static_cast<std::uint32_t>(logs::flag_outage));
    m.def("line_settings", &logs::line_settings);
}

}  // namespace zlg::python
