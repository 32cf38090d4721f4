#pragma once
// Numbers of a column in their order, as many as there are: the last ones in memory, those before them in a file
// without a name (in TMPDIR, or else /tmp), or in memory too where none can be written. One thread at a time may look
// at one: what was read last is kept.

#include <array>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <memory>
#include <vector>

namespace zlg::logs {

class FileDescriptor;

class LongColumn {
public:
    class Iterator {
    public:
        using value_type = double;
        using difference_type = std::ptrdiff_t;
        using reference = double;
        using pointer = const double*;
        using iterator_category = std::forward_iterator_tag;

        Iterator() = default;
        Iterator(const LongColumn* column, std::size_t k) : column_{column}, k_{k} {}
        double operator*() const { return (*column_)[k_]; }
        Iterator& operator++() { return ++k_, *this; }
        Iterator operator++(int) { return {column_, k_++}; }
        bool operator==(const Iterator& other) const { return k_ == other.k_; }
        difference_type operator-(const Iterator& other) const { return static_cast<difference_type>(k_ - other.k_); }

    private:
        const LongColumn* column_ = nullptr;
        std::size_t k_ = 0;
    };

    LongColumn() = default;
    LongColumn(const std::vector<double>& values) : last_(values) {}
    LongColumn(std::initializer_list<double> values) : last_(values) {}
    LongColumn(LongColumn&& other) noexcept { *this = std::move(other); }
    LongColumn& operator=(LongColumn&& other) noexcept;

    [[nodiscard]] std::size_t size() const { return n_away_ + last_.size(); }
    [[nodiscard]] bool empty() const { return size() == 0; }
    // errors  IoError: what was written cannot be read.
    [[nodiscard]] double operator[](std::size_t k) const {
        if (k >= n_away_) return last_[k - n_away_];
        const Block& block = read_[k / block_size % 2];
        return block.number == k / block_size ? block.values[k % block_size] : fetched(k);
    }
    [[nodiscard]] double front() const { return (*this)[0]; }
    [[nodiscard]] double back() const { return (*this)[size() - 1]; }
    [[nodiscard]] Iterator begin() const { return {this, 0}; }
    [[nodiscard]] Iterator end() const { return {this, size()}; }

    void push_back(double value) {
        if (last_.size() >= most_in_memory_) put_away();
        last_.push_back(value);
    }
    // Each becomes of(it), from the first on.
    template <class Of> void change(Of of) {
        LongColumn changed;
        for (const double value : *this) changed.push_back(of(value));
        *this = std::move(changed);
    }
    // All in memory, with room for one more.
    [[nodiscard]] std::vector<double> vector() const;

private:
    static constexpr std::size_t block_size = 8192;
    struct Block {
        std::size_t number = std::numeric_limits<std::size_t>::max();
        std::vector<double> values{};
    };

    void put_away();
    void read(std::size_t at, std::size_t n, double* to) const;
    double fetched(std::size_t k) const;

    std::size_t most_in_memory_ = std::size_t{1} << 18;  // whole blocks
    std::size_t n_away_ = 0;
    std::vector<double> last_;
    std::shared_ptr<FileDescriptor> file_;
    // Of neighbours one each: rows on both sides of a border are often looked at together.
    mutable std::array<Block, 2> read_{};
};

}  // namespace zlg::logs
