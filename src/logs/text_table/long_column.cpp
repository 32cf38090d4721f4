#include <zlg/logs/long_column.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

#include "nameless_file.hpp"

namespace zlg::logs {

LongColumn& LongColumn::operator=(LongColumn&& other) noexcept {
    std::swap(most_in_memory_, other.most_in_memory_);
    std::swap(n_away_, other.n_away_);
    std::swap(last_, other.last_);
    std::swap(file_, other.file_);
    std::swap(read_, other.read_);
    return *this;
}

void LongColumn::put_away() {
    if (!file_) file_ = std::make_shared<FileDescriptor>(nameless_file());
    const std::size_t n = last_.size() / block_size * block_size * sizeof(double);
    const std::string_view bytes{reinterpret_cast<const char*>(last_.data()), n};
    if (!file_->is_open() || write_all(file_->get(), bytes, n_away_ * sizeof(double)).error != 0) {
        most_in_memory_ = std::numeric_limits<std::size_t>::max();
        return;
    }
    n_away_ += n / sizeof(double);
    last_.erase(last_.begin(), last_.begin() + static_cast<std::ptrdiff_t>(n / sizeof(double)));
}

void LongColumn::read(std::size_t at, std::size_t n, double* to) const {
    const ssize_t got = read_at(file_->get(), at * sizeof(double), n * sizeof(double), to);
    if (got != static_cast<ssize_t>(n * sizeof(double)))
        fail_io("read", "the temporary file of a column", got < 0 ? errno : EIO);
}

double LongColumn::fetched(std::size_t k) const {
    Block& block = read_[k / block_size % 2];
    block.values.resize(block_size);
    block.number = std::numeric_limits<std::size_t>::max();  // until it is read
    read(k / block_size * block_size, block_size, block.values.data());
    block.number = k / block_size;
    return block.values[k % block_size];
}

std::vector<double> LongColumn::vector() const {
    std::vector<double> all;
    all.reserve(size() + 1);
    all.resize(n_away_);
    if (n_away_ > 0) read(0, n_away_, all.data());
    all.insert(all.end(), last_.begin(), last_.end());
    return all;
}

}  // namespace zlg::logs
