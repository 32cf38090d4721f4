#pragma once
// The increments of an angle log and their flags, in blocks: what a long log is read for, without its other columns.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace zlg::logs {

enum class AngleColumn { dtheta, dtheta_final };  // as delivered in real time; the best that was known afterwards

class AngleIncrements {
public:
    // CSV or HDF5, recognised by the content.
    //
    // errors  as AngleReader.
    AngleIncrements(const std::string& path, AngleColumn column);
    ~AngleIncrements();
    AngleIncrements(AngleIncrements&&) noexcept;

    // Seconds of a tick, from the log's setting tick_s; absent: it has none.
    [[nodiscard]] std::optional<double> tick_s() const;

    // Fills both, which are of one length, as far as it can; returns how many, 0 at the end.
    //
    // errors  FormatError: a row that is not good; those before it have been returned. Of an HDF5 log only the columns
    // that are read are judged.
    std::size_t read(std::span<double> dtheta_arcsec, std::span<std::uint32_t> flags);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace zlg::logs
