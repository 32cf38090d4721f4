#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/logs/matlab_copy.hpp>

#include "matlab5_file.hpp"
#include "settings_lines.hpp"
#include "toml_settings.hpp"

namespace zlg::logs {
namespace {

// Whole numbers of 64 bits in a log are below 2^53, and as doubles the same.
template <class Value> using Stored = std::conditional_t<sizeof(Value) == 8, double, Value>;
template <class Value> using Column = std::vector<Stored<Value>>;

bool has_light(const RawHeader& header) { return header.light_samples > 0; }
bool has_light(const AngleHeader&) { return false; }
bool has_truth(const RawHeader&) { return false; }
bool has_truth(const AngleHeader& header) { return header.has_truth; }
double truth(const core::HalfRecord&) { return 0.0; }
double truth(const TimedAngle& angle) { return angle.truth_dtheta_arcsec; }

void add_facts(Matlab5File& file, const Settings& settings) {
    for (const char* name : {"tick_s", "scale_arcsec"}) {
        const std::string* text = find_of_gyro(settings, name);
        if (text == nullptr) continue;
        if (const auto value = number_in(*text)) file.add(name, *value);
    }
}

template <class Number>
void add(Matlab5File& file, const char* name, const std::vector<Number>& values, std::size_t rows) {
    file.add(name, std::span<const Number>{values}, rows);
}

}  // namespace

template <class Table> struct MatlabCopy<Table>::State {
    State(const std::string& path, const typename Table::Header& h, bool force)
        : header{h}, settings{settings_to_toml(h.settings)}, file{path, force}, name{path} {}

    void require_room(std::size_t bytes) const {
        if (bytes > max_matlab5_bytes)
            throw FormatError{
                fmt::format("{}: {} rows; a variable of a .mat file holds 2 GiB at most. A log of .h5 has no "
                            "such limit",
                            name, rows)};
    }

    typename Table::Header header;
    std::string settings;
    Matlab5File file;
    std::string name;
    PartsOf<Table, Column> columns;
    std::vector<float> light_a, light_b;
    std::vector<double> truth;
    std::size_t rows = 0;
};

template <class Table>
MatlabCopy<Table>::MatlabCopy(const std::string& path, const typename Table::Header& header, bool force)
    : state_{std::make_unique<State>(path, header, force)} {}

template <class Table> MatlabCopy<Table>::~MatlabCopy() = default;

template <class Table> void MatlabCopy<Table>::write(const typename Table::Row& row, const core::LightSamples& light) {
    State& s = *state_;
    ++s.rows;
    s.require_room(s.rows * sizeof(double));
    for_each_column<Table>(s.columns, [&]<class Field>(const Field& field, auto& values, std::size_t) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if (field.is_in(s.header)) values.push_back(static_cast<Value>(field.of(row)));
    });
    if (has_light(s.header)) {
        s.light_a.insert(s.light_a.end(), light.a.begin(), light.a.end());
        s.light_b.insert(s.light_b.end(), light.b.begin(), light.b.end());
        s.require_room(s.light_a.size() * sizeof(float));
    }
    if (has_truth(s.header)) s.truth.push_back(truth(row));
}

template <class Table> void MatlabCopy<Table>::close() {
    State& s = *state_;
    for_each_column<Table>(s.columns, [&s](const auto& field, const auto& values, std::size_t) {
        if (field.is_in(s.header)) add(s.file, field.name, values, s.rows);
    });
    if (has_truth(s.header)) add(s.file, "truth_dtheta_arcsec", s.truth, s.rows);
    if constexpr (std::same_as<Table, RawTable>) {
        const auto samples = static_cast<std::size_t>(s.header.light_samples);
        if (samples > 0) add(s.file, "light", s.light_a, samples);
        if (s.header.has_light_b) add(s.file, "light_b", s.light_b, samples);
        if (s.header.has_edge_offset) s.file.add("timer_hz", s.header.timer_hz);
    }
    add_facts(s.file, s.header.settings);
    s.file.add_text("settings", s.settings);
    s.file.close();
}

template <class Table> const std::string& MatlabCopy<Table>::part_path() const { return state_->file.part_path(); }

template class MatlabCopy<RawTable>;
template class MatlabCopy<AngleTable>;

}  // namespace zlg::logs
