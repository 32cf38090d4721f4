// Records from a gyro's line, and from a log while it is being written.

#include <zlg/live/record_source.hpp>

#include <chrono>
#include <deque>
#include <thread>
#include <utility>

#include <zlg/logs/follower.hpp>
#include <zlg/rig/replay.hpp>

namespace zlg::live {
namespace {

class LineSource final : public RecordSource {
public:
    LineSource(const std::string& source, int baud) : follower_{source, baud, std::nullopt} {}

    Next next(Record& record) override {
        switch (follower_.next(record.angle)) {
            case logs::Follower::Next::end: return Next::end;
            case logs::Follower::Next::nothing: return Next::nothing;
            case logs::Follower::Next::row: break;
        }
        if (const std::optional<wire::Status>& status = follower_.rows().status()) {
            record.detuning_lambda = status->detuning_lambda;
            record.piezo_v = status->piezo_v;
            record.temperature_c = status->temperature_c;
            record.health = status->health;
        }
        return Next::record;
    }

    void stop() override { follower_.stop(); }
    [[nodiscard]] std::optional<double> tick_s() const override { return follower_.rows().tick_s(); }
    [[nodiscard]] bool tells_health() const override { return true; }
    [[nodiscard]] logs::Settings settings() const override { return logs::line_settings(); }

private:
    logs::Follower follower_;
};

constexpr std::chrono::milliseconds patience{50};

// The next row that is there, or comes.
template <class Reader, class Row> RecordSource::Next next_row(Reader& log, Row& row, bool is_stopped) {
    using Next = RecordSource::Next;
    if (is_stopped) return Next::end;
    if (log.next(row)) return Next::record;
    if (log.refresh()) return log.next(row) ? Next::record : Next::nothing;
    if (log.header().complete) return Next::end;  // what `refresh` knew before it looked for rows
    std::this_thread::sleep_for(patience);
    return Next::nothing;
}

class AngleSource final : public RecordSource {
public:
    explicit AngleSource(logs::AngleReader log)
        : log_{std::move(log)}, tick_s_{logs::said_tick_s(log_.header().settings)} {}

    Next next(Record& record) override {
        logs::TimedAngle angle;
        const Next found = next_row(log_, angle, is_stopped_);
        if (found != Next::record) return found;
        record = {.angle = angle.row};
        return Next::record;
    }

    void stop() override { is_stopped_ = true; }
    [[nodiscard]] std::optional<double> tick_s() const override { return tick_s_; }
    [[nodiscard]] logs::Settings settings() const override { return log_.header().settings; }

private:
    logs::AngleReader log_;
    std::optional<double> tick_s_;
    bool is_stopped_ = false;
};

class RawSource final : public RecordSource {
public:
    RawSource(logs::RawReader log, std::string name, const core::GyroCompensationConfig& compensation, double tick_s,
              logs::Settings settings)
        : log_{std::move(log)},
          name_{std::move(name)},
          replay_{compensation},
          tick_s_{tick_s},
          settings_{std::move(settings)} {}

    Next next(Record& record) override {
        const auto settle = [this](const core::AngleRow& row) { settled_.push_back(row); };
        while (settled_.empty()) {
            if (is_ended_) return Next::end;
            core::HalfRecord half;
            const Next found = next_row(log_, half, is_stopped_);
            if (found == Next::nothing) return found;
            is_ended_ = found == Next::end;
            if (is_ended_)
                replay_.end(settle);
            else
                take(half, settle);
        }
        return take_settled(record);
    }

    void stop() override { is_stopped_ = true; }
    [[nodiscard]] std::optional<double> tick_s() const override { return tick_s_; }
    [[nodiscard]] logs::Settings settings() const override { return settings_; }
    [[nodiscard]] std::vector<std::string> warnings() const override {
        std::vector<std::string> all = log_.header().warnings;
        for (std::string& wrong : replay_.contradictions(name_)) all.push_back(std::move(wrong));
        return all;
    }

private:
    template <class Settle> void take(const core::HalfRecord& half, const Settle& settle) {
        const bool has_light = log_.header().light_samples > 0;
        const double before_lambda = std::exchange(detuning_lambda_, half.detuning_lambda);
        const core::CompensationOutput out =
            replay_.take(half, has_light ? log_.light() : core::LightSamples{}, settle);
        if (!out.has_sample) return;
        ticks_.push_back({.detuning_lambda = 0.5 * (before_lambda + half.detuning_lambda),
                          .piezo_v = half.piezo_v,
                          .temperature_c = half.temperature_c});
    }

    Next take_settled(Record& record) {
        record = ticks_.empty() ? Record{} : ticks_.front();
        if (!ticks_.empty()) ticks_.pop_front();
        record.angle = settled_.front();
        settled_.pop_front();
        return Next::record;
    }

    logs::RawReader log_;
    std::string name_;
    rig::Replay replay_;
    double tick_s_;
    logs::Settings settings_;
    double detuning_lambda_ = 0.0;        // of the half before
    std::deque<Record> ticks_;            // that are not settled, without their angles
    std::deque<core::AngleRow> settled_;  // that were not handed out
    bool is_stopped_ = false;
    bool is_ended_ = false;
};

}  // namespace

std::unique_ptr<RecordSource> line_source(const std::string& source, int baud) {
    return std::make_unique<LineSource>(source, baud);
}

std::unique_ptr<RecordSource> log_source(logs::AngleReader log) {
    return std::make_unique<AngleSource>(std::move(log));
}

std::unique_ptr<RecordSource> log_source(logs::RawReader log, std::string name,
                                         const core::GyroCompensationConfig& compensation, double tick_s,
                                         logs::Settings settings) {
    return std::make_unique<RawSource>(std::move(log), std::move(name), compensation, tick_s, std::move(settings));
}

}  // namespace zlg::live
