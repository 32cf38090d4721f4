#include <zlg/text/toml_depth.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace zlg::text {
namespace {

// Reads TOML without understanding it: brackets, the dots of keys, and what is to be skipped.
class Scanner {
public:
    explicit Scanner(std::string_view toml) : text_{toml} {}

    std::optional<Place> run() {
        for (; at_ < text_.size(); ++at_) {
            take(text_[at_]);
            if (levels() > max_toml_levels) return place();
        }
        return std::nullopt;
    }

private:
    void take(char c) {
        switch (c) {
            case '#':
                at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
                return;
            case '"':
            case '\'':
                skip_string(c);
                begins_ = false;
                return;
            case '\n':
                end_line();
                return;
            case ' ':
            case '\t':
            case '\r':
                return;
            default:
                take_structure(c);
                begins_ = false;
        }
    }

    void take_structure(char c) {
        switch (c) {
            case '[':
                if (begins_) {
                    header_ = true;
                    header_levels_ = 0;
                } else if (!header_) {
                    open();
                }
                return;
            case ']':
                if (header_)
                    end_header();
                else
                    close();
                return;
            case '{':
                open();
                return;
            case '}':
                close();
                return;
            case '.':
                ++dots_;
                return;
            case '=':
                key_levels_[n_open_] = dots_ + 1;
                dots_ = 0;
                return;
            case ',':
                dots_ = 0;
                key_levels_[n_open_] = 0;
                return;
            default:
                return;
        }
    }

    // A key of the outermost level is over with its line; a value in brackets goes on.
    void end_line() {
        ++line_;
        line_begin_ = at_ + 1;
        dots_ = 0;
        if (n_open_ > 0) return;
        header_ = false;
        begins_ = true;
        key_levels_[0] = 0;
    }

    void end_header() {
        if (header_levels_ == 0) header_levels_ = dots_ + 1;
        dots_ = 0;
    }

    void open() {
        dots_ = 0;
        inner_levels_ += key_levels_[n_open_] + 1;
        key_levels_[++n_open_] = 0;
    }

    void close() {
        dots_ = 0;
        if (n_open_ == 0) return;
        inner_levels_ -= key_levels_[--n_open_] + 1;
    }

    void skip_string(char quote) {
        const bool is_long = text_.substr(at_).starts_with(quote == '"' ? "\"\"\"" : "'''");
        for (at_ += is_long ? 3 : 1; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '\\' && quote == '"' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') {
                ++at_;
            } else if (c == '\n') {
                if (!is_long) {
                    --at_;  // no TOML: the parser will say so
                    return;
                }
                ++line_;
                line_begin_ = at_ + 1;
            } else if (c == quote && ends_string(quote, is_long)) {
                return;
            }
        }
    }

    // Three quotes end a long string, and up to two more may stand before them.
    bool ends_string(char quote, bool is_long) {
        if (!is_long) return true;
        std::size_t n = 0;
        while (at_ + n < text_.size() && text_[at_ + n] == quote) ++n;
        if (n < 3) return false;
        at_ += std::min<std::size_t>(n, 5) - 1;
        return true;
    }

    [[nodiscard]] int levels() const { return header_levels_ + inner_levels_ + key_levels_[n_open_] + dots_; }

    [[nodiscard]] Place place() const {
        return {line_, static_cast<std::uint32_t>(std::min(at_, text_.size()) - line_begin_ + 1)};
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::uint32_t line_ = 1;
    std::size_t line_begin_ = 0;
    bool begins_ = true;     // nothing stood on this line yet, and no bracket is open
    bool header_ = false;    // between [ and ] of a section's name, or after it
    int header_levels_ = 0;  // of the section
    int inner_levels_ = 0;   // of open brackets, and of the keys before them
    int dots_ = 0;           // of the key or number that is being read
    std::size_t n_open_ = 0;
    // Of the keys whose values are being read, by how many brackets are open; each bracket is a level.
    std::array<int, max_toml_levels + 2> key_levels_{};
};

}  // namespace

std::optional<Place> too_deep(std::string_view toml) { return Scanner{toml}.run(); }

}  // namespace zlg::text
