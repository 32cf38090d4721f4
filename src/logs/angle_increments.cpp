#include <zlg/logs/angle_increments.hpp>

#include <algorithm>
#include <cmath>
#include <zlg/logs/angle_log.hpp>

#include "column_map.hpp"
#include "hdf5/hdf5_table_reader.hpp"
#include "settings_lines.hpp"
#include "signature.hpp"

namespace zlg::logs {
namespace {

// Two columns of an HDF5 log.
class TwoColumns {
public:
    TwoColumns(const std::string& path, AngleColumn column)
        : table_{path, AngleTable::group, known_columns<AngleTable>} {
        const char* name = column == AngleColumn::dtheta ? "dtheta_arcsec" : "dtheta_final_arcsec";
        table_.open(column_named<AngleTable>(name), dtheta_arcsec_);
        table_.open(column_named<AngleTable>("flags"), flags_);
        table_.measure();
    }

    std::size_t read(std::span<double> dtheta_arcsec, std::span<std::uint32_t> flags) {
        if (next_row_ == table_.block().good_rows() && !next_block()) return 0;
        const std::size_t n = std::min({dtheta_arcsec.size(), flags.size(), table_.block().good_rows() - next_row_});
        std::copy_n(dtheta_arcsec_.values() + next_row_, n, dtheta_arcsec.begin());
        std::copy_n(flags_.values() + next_row_, n, flags.begin());
        next_row_ += n;
        return n;
    }

private:
    bool next_block() {
        return table_.next_block([this](hdf5::Block& block) {
            next_row_ = 0;
            block.take(dtheta_arcsec_, Real{});
            block.take(flags_, any_whole<std::uint32_t>);
        });
    }

    hdf5::TableReader table_;
    hdf5::Column<double> dtheta_arcsec_;
    hdf5::Column<std::uint32_t> flags_;
    std::size_t next_row_ = 0;
};

}  // namespace

struct AngleIncrements::State {
    State(const std::string& path, AngleColumn wanted) : rows(path), column(wanted) {
        if (has_hdf5_signature(path)) columns = std::make_unique<TwoColumns>(path, wanted);
    }

    std::size_t read_rows(std::span<double> dtheta_arcsec, std::span<std::uint32_t> flags) {
        TimedAngle angle;
        std::size_t n = 0;
        for (; n < std::min(dtheta_arcsec.size(), flags.size()) && rows.next(angle); ++n) {
            dtheta_arcsec[n] = column == AngleColumn::dtheta ? angle.row.dtheta_arcsec : angle.row.dtheta_final_arcsec;
            flags[n] = angle.row.flags;
        }
        return n;
    }

    AngleReader rows;  // of an HDF5 log only the header
    AngleColumn column;
    std::unique_ptr<TwoColumns> columns;
};

AngleIncrements::AngleIncrements(const std::string& path, AngleColumn column)
    : state_{std::make_unique<State>(path, column)} {}
AngleIncrements::~AngleIncrements() = default;
AngleIncrements::AngleIncrements(AngleIncrements&&) noexcept = default;

std::optional<double> AngleIncrements::tick_s() const {
    for (const auto& [key, value] : state_->rows.header().settings) {
        if (key != "tick_s") continue;
        const auto tick_s = number_in(value);
        if (tick_s && std::isfinite(*tick_s) && *tick_s > 0.0) return tick_s;
    }
    return std::nullopt;
}

std::size_t AngleIncrements::read(std::span<double> dtheta_arcsec, std::span<std::uint32_t> flags) {
    return state_->columns ? state_->columns->read(dtheta_arcsec, flags) : state_->read_rows(dtheta_arcsec, flags);
}

}  // namespace zlg::logs
