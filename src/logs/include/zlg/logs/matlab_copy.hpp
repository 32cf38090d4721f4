#pragma once
// A log for MATLAB: a file of its level 5 (`-v6`), one variable a column.
//
// Every column is a vector of doubles, named as in a CSV log; `light` and `light_b` are samples by halves, as h5read
// gives them; `truth_dtheta_arcsec` is the true increment. `settings` is the text of /config in an HDF5 log; `tick_s`,
// `scale_arcsec` and `timer_hz` are there where the log says them. zlg itself reads such a file as one of another
// program.

#include <memory>
#include <string>

#include <zlg/core/records.hpp>
#include <zlg/logs/angle_layout.hpp>
#include <zlg/logs/raw_layout.hpp>

namespace zlg::logs {

// The rows are held in memory until `close`, as MATLAB will hold them. The file appears under its name then, whole, or
// not at all.
template <class Table> class MatlabCopy {
public:
    // errors  IoError, as the writers of logs; FormatError: a setting with a line break.
    MatlabCopy(const std::string& path, const typename Table::Header& header, bool force);
    ~MatlabCopy();

    // errors  FormatError: a variable larger than MATLAB reads.
    void write(const typename Table::Row& row, const core::LightSamples& light = {});

    // errors  IoError.
    void close();

    [[nodiscard]] const std::string& part_path() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

extern template class MatlabCopy<RawTable>;
extern template class MatlabCopy<AngleTable>;

}  // namespace zlg::logs
