#include <zlg/acceptance/accept.hpp>

#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/logs/content_hash.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/study/how_made.hpp>

#include "moved_values.hpp"
#include "repeated_stretch.hpp"
#include "values.hpp"

namespace zlg::acceptance {
namespace {

bool is_still(RunKind kind) { return kind == RunKind::at_rest || kind == RunKind::switching; }

class Test {
public:
    explicit Test(const AcceptTask& task) : task_{task} {
        result_.plan = read_plan(task.plan);
        result_.plan_checksum = logs::hash_of_file(task.plan);
        result_.settings = study::own_settings(task.said);
    }

    Acceptance finish() {
        for (const Run& run : result_.plan.runs) {
            if (task_.on_progress)
                task_.on_progress(static_cast<double>(run.number - 1) / static_cast<double>(result_.plan.runs.size()));
            records_.push_back(read_run(result_.plan, run, task_.said));
            require_new(records_.back());
            look_at(records_.back());
            analyze(records_.back());
        }
        const Found moved = moved_values();
        for (RunRecord& record : records_) {
            const bool has_counts = record.run->mapping.has("scale_arcsec") || !record.raw_logs.empty();
            if (has_counts && record.run->kind != RunKind::rate_table && !moved.wrong_scale.empty())
                record.stops.push_back(moved.wrong_scale);
            result_.runs.push_back(
                {record.run->number, record.run->kind, record.hours, record.logs, record.notes, record.stops});
        }
        std::vector<Value> values = moved.values;
        const auto take = [&](std::vector<Value> more) { std::ranges::move(more, std::back_inserter(values)); };
        // What raw logs tell goes before what the noise of any record does.
        if (const auto raw = raw_logs(); !raw.empty()) take(constants(raw));
        if (!still_.empty()) take(still_values(result_.plan, still_));
        std::vector<SwitchRecord> switches;
        for (RunRecord& record : records_)
            if (is_still(record.run->kind)) std::ranges::move(record.switches, std::back_inserter(switches));
        if (!switches.empty()) take(switch_values(switches, still_));
        for (const QuantityInfo& q : quantities()) judge_one(q, values);
        if (result_.passed()) result_.unit_risk = unit_risk(result_.quantities);
        return std::move(result_);
    }

private:
    void analyze(RunRecord& record) {
        const RunKind kind = record.run->kind;
        if (!is_still(kind) && kind != RunKind::magnetic) return;
        const study::AnalysisTask task{.config = task_.said.analysis, .threads = task_.threads, .with_page = true};
        for (study::AxisRecord& axis : record.axes) {
            try {
                StillAxis found{.run = record.run, .result = study::analyze_axis(task, std::move(axis))};
                if (const std::string why = wrong_way(result_.plan, found); !why.empty()) record.stops.push_back(why);
                std::ranges::move(study::axis_figures(task.config, found.result, still_.size() + in_field_.size()),
                                  std::back_inserter(result_.figures));
                (is_still(kind) ? still_ : in_field_).push_back(std::move(found));
            } catch (const deviations::SeriesError& error) {
                record.stops.emplace_back(error.what());
            }
        }
    }

    Found moved_values() {
        Found all;
        const auto of_kind = [&](RunKind kind) {
            std::vector<RunRecord*> found;
            for (RunRecord& record : records_)
                if (record.run->kind == kind && !record.axes.empty()) found.push_back(&record);
            return found;
        };
        const auto take = [&](Found found) {
            std::ranges::move(found.values, std::back_inserter(all.values));
            std::ranges::move(found.figures, std::back_inserter(result_.figures));
            if (!found.wrong_scale.empty()) all.wrong_scale = found.wrong_scale;
        };
        if (const auto tables = of_kind(RunKind::rate_table); !tables.empty())
            take(table_values(result_.plan, tables, task_.said.analysis));
        if (const auto warmed = of_kind(RunKind::temperature); !warmed.empty()) take(temperature_values(warmed));
        if (const auto cold = of_kind(RunKind::warm_up); !cold.empty()) take(warm_up_values(result_.plan, cold));
        if (!in_field_.empty()) take(magnetic_values(result_.plan, in_field_));
        return all;
    }

    static void look_at(RunRecord& record) {
        for (const study::AxisRecord& axis : record.axes) {
            record.hours += static_cast<double>(axis.rates_arcsec_s.size()) / axis.rate_hz / 3600.0;
            if (const std::string line = repeated_stretch(axis.rates_arcsec_s); !line.empty())
                record.stops.push_back(fmt::format("{}: {}", axis.name, line));
        }
    }

    // A measurement under two names, or in two runs of one kind, would agree with itself too well.
    void require_new(const RunRecord& record) {
        for (const TestedLog& log : record.logs)
            if (!seen_.emplace(is_still(record.run->kind) ? RunKind::at_rest : record.run->kind, log.checksum).second)
                throw logs::FormatError(fmt::format("{}: {} is in the plan once more; each measurement counts once",
                                                    record.run->place, log.file));
    }

    [[nodiscard]] std::vector<std::string> raw_logs() const {
        std::vector<std::string> all;
        for (const RunRecord& record : records_)
            if (record.run->kind != RunKind::rate_table && record.run->kind != RunKind::magnetic &&
                record.stops.empty())
                all.insert(all.end(), record.raw_logs.begin(), record.raw_logs.end());
        return all;
    }

    [[nodiscard]] std::vector<Value> constants(const std::vector<std::string>& raw) const {
        config::Config said = task_.said;
        const auto& nominal = result_.plan.unit.scale_arcsec;
        const auto agrees = [&](const RunRecord& r) {
            return std::ranges::all_of(r.configs,
                                       [&](const config::Config& c) { return c.gyro.scale_arcsec == *nominal; });
        };
        if (nominal && std::ranges::all_of(records_, agrees))
            config::apply_pair(said, "gyro.scale_arcsec", fmt::format("{}", *nominal), result_.plan.path);
        std::vector<std::string> ignored;
        const auto open = [&](const std::string& path) {
            for (const RunRecord& record : records_)
                if (std::ranges::count(record.raw_logs, path) > 0) return open_raw(*record.run, path, ignored);
            throw logs::IoError(fmt::format("{}: is no log of the plan", path));
        };
        return constant_values(study::calibrate({.logs = raw, .said = said, .open = open, .on_progress = {}}));
    }

    // A run whose values are no measurements leaves open all that it would have told.
    [[nodiscard]] std::optional<std::string> stopped(const QuantityInfo& q) const {
        for (const TestedRun& run : result_.runs)
            if (!run.stops.empty() && std::ranges::find(q.kinds, run.kind) != q.kinds.end())
                return fmt::format("run {} is no measurement: {}", run.number, run.stops.front());
        return std::nullopt;
    }

    void judge_one(const QuantityInfo& q, const std::vector<Value>& values) {
        auto found = std::ranges::find_if(values, [&](const Value& v) { return v.name == q.name && v.determined; });
        if (found == values.end()) found = std::ranges::find(values, q.name, &Value::name);
        Value value = found != values.end() ? *found : not_determined(q.name, fmt::format("needs {}", q.needs));
        if (const auto why = stopped(q)) value = not_determined(q.name, *why);
        const auto limit = std::ranges::find(result_.plan.limits, q.name, &Limit::name);
        result_.quantities.push_back(
            judge(value, limit == result_.plan.limits.end() ? std::nullopt : std::optional{*limit}, result_.plan.risk));
    }

    const AcceptTask& task_;
    Acceptance result_;
    std::vector<RunRecord> records_;
    std::vector<StillAxis> still_, in_field_;
    std::set<std::pair<RunKind, std::uint64_t>> seen_;
};

}  // namespace

bool Acceptance::passed() const {
    const auto counts = [this](auto of) { return std::ranges::count_if(quantities, of); };
    const auto limited = counts([](const Judged& one) { return one.limit.has_value(); });
    return limited > 0 && limited == counts([](const Judged& one) { return one.verdict == Verdict::pass; });
}

Acceptance accept(const AcceptTask& task) { return Test{task}.finish(); }

}  // namespace zlg::acceptance
