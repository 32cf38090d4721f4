#include "stored_numbers.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <zlg/logs/error.hpp>
#include <zlg/text/inputs.hpp>

#include "inflated.hpp"

namespace zlg::logs {

struct Piece::Source {
    std::string path;
    FileDescriptor file;
    Piece packed;  // of `unpacked`, where there is any
    std::unique_ptr<Inflated> unpacked;
    std::size_t at = 0;  // of what `unpacked` makes next

    void read_unpacked(std::size_t from, std::size_t n, char* to) {
        std::array<char, 4096> passed;
        if (!unpacked || from < at) {
            unpacked = std::make_unique<Inflated>(
                packed.size(), [this](std::size_t k, std::size_t m, char* in) { packed.read(k, m, in); });
            at = 0;
        }
        bool is_there = true;
        while (at < from && is_there) {
            const std::size_t now = std::min(passed.size(), from - at);
            is_there = unpacked->next(now, passed.data()) == now;
            at += now;
        }
        if (!is_there || unpacked->next(n, to) != n) throw IoError(fmt::format("cannot read {}: it was cut off", path));
        at += n;
    }
};

Piece Piece::of_file(const std::string& path) {
    Piece piece;
    auto source =
        std::make_shared<Source>(Source{.path = path, .file = open_to_read(path), .packed = {}, .unpacked = {}});
    text::note_input(source->file.get());
    struct stat status {};
    if (::fstat(source->file.get(), &status) != 0)
        throw IoError(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
    piece.size_ = static_cast<std::size_t>(std::max<off_t>(status.st_size, 0));
    piece.source_ = std::move(source);
    return piece;
}

Piece Piece::of_packed(const Piece& packed, std::size_t size) {
    Piece piece;
    piece.size_ = size;
    piece.source_ =
        std::make_shared<Source>(Source{.path = packed.source_->path, .file = {}, .packed = packed, .unpacked = {}});
    return piece;
}

bool Piece::is_packed() const { return source_->packed.size() > 0; }

Piece Piece::part(std::size_t at, std::size_t n) const {
    Piece piece = *this;
    piece.begin_ += at;
    piece.size_ = n;
    return piece;
}

void Piece::read(std::size_t at, std::size_t n, char* to) const {
    if (is_packed()) return source_->read_unpacked(begin_ + at, n, to);
    const ssize_t got = read_at(source_->file.get(), begin_ + at, n, to);
    if (got != static_cast<ssize_t>(n))
        throw IoError(
            fmt::format("cannot read {}: {}", source_->path, got < 0 ? std::strerror(errno) : "it was cut off"));
}

std::string Piece::text(std::size_t at, std::size_t n) const {
    std::string read_text(n, '\0');
    read(at, n, read_text.data());
    return read_text;
}

namespace {

template <class Number> Number swapped(Number number) {
    std::array<char, sizeof number> bytes;
    std::memcpy(bytes.data(), &number, sizeof number);
    std::ranges::reverse(bytes);
    std::memcpy(&number, bytes.data(), sizeof number);
    return number;
}

// Calls use(Number{}) with a number of the type.
template <class Use> void with(NumberType type, Use use) {
    switch (type) {
        case NumberType::i1: return use(std::int8_t{});
        case NumberType::u1: return use(std::uint8_t{});
        case NumberType::i2: return use(std::int16_t{});
        case NumberType::u2: return use(std::uint16_t{});
        case NumberType::i4: return use(std::int32_t{});
        case NumberType::u4: return use(std::uint32_t{});
        case NumberType::i8: return use(std::int64_t{});
        case NumberType::u8: return use(std::uint64_t{});
        case NumberType::f4: return use(float{});
        case NumberType::f8: return use(double{});
    }
}

// `n` numbers from the one of index `at` on.
std::vector<double> numbers(const StoredMatrix& stored, std::size_t at, std::size_t n) {
    constexpr std::size_t block = 8192;
    std::vector<double> values(n);
    with(stored.type, [&]<class Number>(Number) {
        std::array<Number, block> read;
        for (std::size_t done = 0; done < n;) {
            const std::size_t now = std::min(block, n - done);
            stored.bytes.read((at + done) * sizeof(Number), now * sizeof(Number), reinterpret_cast<char*>(read.data()));
            for (std::size_t k = 0; k < now; ++k)
                values[done + k] = static_cast<double>(stored.swapped ? swapped(read[k]) : read[k]);
            done += now;
        }
    });
    return values;
}

}  // namespace

std::size_t size_of(NumberType type) {
    std::size_t size = 0;
    with(type, [&size]<class Number>(Number) { size = sizeof(Number); });
    return size;
}

void StoredMatrix::take_shape(std::size_t n, std::size_t m, bool last_index_follows) {
    rows = std::max(n, m);
    columns = std::min(n, m);
    rows_follow = (n >= m) == last_index_follows;
}

ForeignArray array_of(const std::string& name, const StoredMatrix& stored) {
    ForeignArray array{.name = name,
                       .unit = {},
                       .rows = stored.rows,
                       .columns = stored.columns,
                       .may_be_rounded = stored.type == NumberType::i8 || stored.type == NumberType::u8,
                       // What is packed is unpacked from its beginning to go back to a column before.
                       .rows_at_once = stored.bytes.is_packed() && stored.columns > 1 ? stored.rows : 1,
                       .read = {}};
    array.read = [stored](std::size_t from, std::size_t n, bool) {
        if (stored.rows_follow)
            return by_columns(numbers(stored, from * stored.columns, n * stored.columns), stored.columns);
        std::vector<double> values;
        values.reserve(n * stored.columns);
        for (std::size_t c = 0; c < stored.columns; ++c) {
            const std::vector<double> column = numbers(stored, c * stored.rows + from, n);
            values.insert(values.end(), column.begin(), column.end());
        }
        return values;
    };
    return array;
}

std::vector<double> by_columns(std::vector<double> by_rows, std::size_t columns) {
    if (columns == 1) return by_rows;
    const std::size_t rows = by_rows.size() / columns;
    std::vector<double> values(by_rows.size());
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c) values[c * rows + r] = by_rows[r * columns + c];
    return values;
}

}  // namespace zlg::logs
