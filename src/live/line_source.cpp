// Records from a gyro's line.

#include <zlg/live/record_source.hpp>

#include <zlg/logs/follower.hpp>

namespace zlg::live {
namespace {

class LineSource final : public RecordSource {
public:
    LineSource(const std::string& source, int baud) : follower_{source, baud, std::nullopt} {}

    Next next(Record& record) override {
        switch (follower_.next(record.angle)) {
            case logs::Follower::Next::end:
                return Next::end;
            case logs::Follower::Next::nothing:
                return Next::nothing;
            case logs::Follower::Next::row:
                break;
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

}  // namespace

std::unique_ptr<RecordSource> line_source(const std::string& source, int baud) {
    return std::make_unique<LineSource>(source, baud);
}

}  // namespace zlg::live
