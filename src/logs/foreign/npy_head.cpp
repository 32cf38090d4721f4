#include "npy_head.hpp"

#include <charconv>

namespace zlg::logs {

namespace {

class Literal {
public:
    explicit Literal(std::string_view rest) : rest_{rest} {}

    [[nodiscard]] bool at_end() {
        skip_blanks();
        return rest_.empty();
    }

    bool take(std::string_view word) {
        skip_blanks();
        if (!rest_.starts_with(word)) return false;
        rest_.remove_prefix(word.size());
        return true;
    }

    std::optional<std::string> text() {
        const char quote = take("'") ? '\'' : take("\"") ? '"' : '\0';
        const std::size_t end = quote == '\0' ? std::string_view::npos : rest_.find(quote);
        if (end == std::string_view::npos) return std::nullopt;
        std::string found{rest_.substr(0, end)};
        rest_.remove_prefix(end + 1);
        // Text behind text is part of it, and a backslash more than a letter.
        skip_blanks();
        const bool goes_on = rest_.starts_with('\'') || rest_.starts_with('"');
        if (goes_on || found.find_first_of("\\\n\r") != std::string::npos) return std::nullopt;
        return found;
    }

    std::optional<bool> truth() {
        if (take("True")) return true;
        if (take("False")) return false;
        return std::nullopt;
    }

    // A tuple of whole numbers: (), (8,), (8, 3). One number in brackets is none.
    std::optional<std::vector<std::size_t>> tuple() {
        std::vector<std::size_t> numbers;
        if (!take("(")) return std::nullopt;
        bool is_behind_comma = true, is_tuple = true;
        while (!take(")")) {
            const auto one = is_behind_comma ? whole() : std::nullopt;
            if (!one || numbers.size() == 32) return std::nullopt;
            numbers.push_back(*one);
            is_behind_comma = take(",");
            is_tuple = is_behind_comma || numbers.size() > 1;
        }
        return is_tuple ? std::optional{numbers} : std::nullopt;
    }

private:
    void skip_blanks() {
        const std::size_t n = rest_.find_first_not_of(" \t\n\r\f");
        rest_.remove_prefix(n == std::string_view::npos ? rest_.size() : n);
    }

    std::optional<std::size_t> whole() {
        skip_blanks();
        std::size_t value = 0;
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        const auto n = static_cast<std::size_t>(end - rest_.data());
        if (error != std::errc{} || (n > 1 && rest_.front() == '0')) return std::nullopt;
        rest_.remove_prefix(n);
        return value;
    }

    std::string_view rest_;
};

}  // namespace

std::optional<NpyHead> npy_head(std::string_view text) {
    Literal literal{text};
    std::optional<std::string> descr;
    std::optional<bool> fortran_order;
    std::optional<std::vector<std::size_t>> shape;
    if (!literal.take("{")) return std::nullopt;
    bool is_behind_comma = true;
    while (!literal.take("}")) {
        const auto key = is_behind_comma ? literal.text() : std::nullopt;
        if (!key || !literal.take(":")) return std::nullopt;
        bool good = false;
        if (*key == "descr" && !descr) good = (descr = literal.text()).has_value();
        if (*key == "fortran_order" && !fortran_order) good = (fortran_order = literal.truth()).has_value();
        if (*key == "shape" && !shape) good = (shape = literal.tuple()).has_value();
        if (!good) return std::nullopt;
        is_behind_comma = literal.take(",");
    }
    if (!descr || !fortran_order || !shape || !literal.at_end()) return std::nullopt;
    return NpyHead{.descr = *descr, .fortran_order = *fortran_order, .shape = *shape};
}

}  // namespace zlg::logs
