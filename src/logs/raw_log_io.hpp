#pragma once
// What a raw log can do, whatever its format.

#include <memory>
#include <zlg/core/records.hpp>
#include <zlg/logs/raw_layout.hpp>

namespace zlg::logs {

class RawSource {
public:
    virtual ~RawSource() = default;
    virtual bool next(core::HalfRecord& record) = 0;
    virtual bool refresh() { return false; }
    [[nodiscard]] virtual core::LightSamples light() const { return {}; }
    [[nodiscard]] virtual bool line_is_ended() const { return true; }
    [[nodiscard]] virtual double fraction_read() const = 0;
    [[nodiscard]] const RawHeader& header() const { return header_; }

protected:
    RawHeader header_;
};

class RawSink {
public:
    virtual ~RawSink() = default;
    virtual void write(const core::HalfRecord& record, const core::LightSamples& light) = 0;
    virtual void flush() = 0;
    virtual void close() = 0;
    [[nodiscard]] virtual const std::string& part_path() const = 0;
};

[[nodiscard]] std::unique_ptr<RawSource> open_raw_csv(const std::string& path);
[[nodiscard]] std::unique_ptr<RawSource> open_raw_hdf5(const std::string& path);
[[nodiscard]] std::unique_ptr<RawSink> create_raw_csv(const std::string& path, const Settings& settings, bool force,
                                                      const RawColumns& columns);
[[nodiscard]] std::unique_ptr<RawSink> create_raw_hdf5(const std::string& path, const Settings& settings, bool force,
                                                       const RawColumns& columns, const RawWriterOptions& options);

// A number of a row that no reader would accept. errors  FormatError, always.
[[noreturn]] void refuse_raw(const core::HalfRecord& record, std::string_view name, double value);

// A shift that no column takes. errors  FormatError, always.
[[noreturn]] void refuse_edge_offset(const core::HalfRecord& record);

// Counts over several halves that no column tells. errors  FormatError, always.
[[noreturn]] void refuse_span(const core::HalfRecord& record);

// Finite detunings that no reader would accept. errors  FormatError.
void require_detunings(const RawColumns& columns, const core::HalfRecord& record);

inline void require_columns(const RawColumns& columns, const core::HalfRecord& record) {
    if (!columns.has_edge_offset && record.edge_offset_ticks != 0) refuse_edge_offset(record);
    if (!columns.has_span && record.span != 1) refuse_span(record);
    require_detunings(columns, record);
}

}  // namespace zlg::logs
